#include "protocol/basis/curve_projection.h"

namespace relume::basis {

void project_rest(std::span<float> coefficients) {
    coefficients[CurveBasis::kRest] = 1;
}

void project_curve(const CurveBasis& basis,
                   std::uint32_t curve,
                   float diffuse,
                   std::span<const float, kDaubechies4Size> samples,
                   std::span<float> coefficients) {
    const std::size_t first = basis.first_coefficient(curve);
    coefficients[first] = diffuse;
    daubechies4_forward(samples, coefficients.subspan(first + 1).first<kDaubechies4Size>());
}

}  // namespace relume::basis
