#include "tests/lab/methods/light_radiance.h"

namespace relume::lab {

void radiance_from_coefficients(std::span<const float> coefficients,
                                const basis::CubemapProjection& projection,
                                light::LightCubemap& out) {
    const std::size_t count = projection.basis().coefficient_count();
    out.reset(projection.basis().face_resolution());
    for (std::size_t colour = 0; colour < out.planes().size(); ++colour) {
        projection.reconstruct_radiance(coefficients.subspan(colour * count, count),
                                        out.planes()[colour]);
    }
}

}  // namespace relume::lab
