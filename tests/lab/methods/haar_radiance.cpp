#include "tests/lab/methods/haar_radiance.h"

#include "protocol/basis/haar.h"

#include <algorithm>

namespace relume::lab {

void radiance_from_haar(std::span<const float> coefficients,
                        std::uint32_t n,
                        light::LightCubemap& out) {
    out.reset(n);
    std::copy(coefficients.begin(), coefficients.end(), out.radiance.begin());
    for (const std::span<float> plane : out.planes()) {
        basis::haar_inverse_cubemap(n, plane);
    }
}

}  // namespace relume::lab
