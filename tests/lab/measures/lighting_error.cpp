#include "tests/lab/measures/lighting_error.h"

#include "protocol/basis/cubemap.h"

#include <cmath>
#include <stdexcept>

namespace relume::lab {

double lighting_error_l1(const light::LightCubemap& shown, const light::LightCubemap& target) {
    if (shown.face_resolution != target.face_resolution) {
        throw std::invalid_argument("lighting error of cubemaps of two resolutions");
    }
    const std::uint32_t n = target.face_resolution;
    const auto shown_planes = shown.planes();
    const auto target_planes = target.planes();
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < target.plane_size(); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        const double solid_angle = basis::solid_angle_sr(n, texel.row, texel.column);
        for (std::size_t c = 0; c < target_planes.size(); ++c) {
            const double wanted = target_planes[c][i];
            difference += solid_angle * std::abs(wanted - double{shown_planes[c][i]});
            norm += solid_angle * std::abs(wanted);
        }
    }
    if (norm == 0) {
        return difference == 0 ? 0 : 1;
    }
    return difference / norm;
}

}  // namespace relume::lab
