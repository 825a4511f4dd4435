#include "tests/support/published_fits.h"

#include "protocol/curve/curve_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relume::test {

Imath::V3f PublishedFit::evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const {
    const Imath::V3d i(wi);
    const Imath::V3d o(wo);
    const Imath::V3d half = (i + o).normalized();
    const double of_difference = std::min(1.0, half.dot(i));
    const double fresnel = curve::fresnel_reflectance(of_difference, index, 0);
    const double grooves =
        std::min({1.0, 2 * half.z * i.z / of_difference, 2 * half.z * o.z / of_difference});
    const double lobe = fresnel * grooves /
                        (std::pow(1 + width * (1 - std::min(1.0, half.z)), power) * i.z * o.z);
    return Imath::V3f((diffuse + scale * lobe) * std::numbers::inv_pi);
}

std::span<const PublishedFit> published_fits() {
    static const std::array<PublishedFit, 3> all{{{.name = "nickel",
                                                   .diffuse = {0.006227, 0.006663, 0.007587},
                                                   .scale = {36.614742, 32.745403, 28.906111},
                                                   .width = 705.733887,
                                                   .power = 1.945258,
                                                   .index = 5.441883},
                                                  {.name = "red-plastic",
                                                   .diffuse = {0.268000, 0.044432, 0.010675},
                                                   .scale = {1.081538, 1.045352, 1.037089},
                                                   .width = 34.117554,
                                                   .power = 1.529797,
                                                   .index = 1.666450},
                                                  {.name = "red-fabric",
                                                   .diffuse = {0.185341, 0.020015, 0.003522},
                                                   .scale = {0.934393, 0.314632, 0.273278},
                                                   .width = 130451.187500,
                                                   .power = 0.287254,
                                                   .index = 3.335066}}};
    return all;
}

}  // namespace relume::test
