#include "tests/lab/measures/lighting_error.h"

#include "protocol/basis/cubemap.h"

#include <cmath>
#include <stdexcept>

namespace relume::lab {

LightingError::LightingError(std::uint32_t face_resolution) {
    for (std::size_t i = 0; i < basis::texel_count(face_resolution); ++i) {
        const basis::Texel texel = basis::texel_from_index(face_resolution, i);
        solid_angles_sr_.push_back(
            basis::solid_angle_sr(face_resolution, texel.row, texel.column));
    }
}

double LightingError::relative_l1(const light::LightCubemap& shown,
                                  const light::LightCubemap& target) const {
    if (shown.plane_size() != solid_angles_sr_.size() ||
        target.plane_size() != solid_angles_sr_.size()) {
        throw std::invalid_argument("lighting error of cubemaps of different resolutions");
    }
    const auto shown_planes = shown.planes();
    const auto target_planes = target.planes();
    double difference = 0;
    double norm = 0;
    for (std::size_t c = 0; c < target_planes.size(); ++c) {
        for (std::size_t i = 0; i < solid_angles_sr_.size(); ++i) {
            const double wanted = target_planes[c][i];
            difference += solid_angles_sr_[i] * std::abs(wanted - double{shown_planes[c][i]});
            norm += solid_angles_sr_[i] * std::abs(wanted);
        }
    }
    if (norm == 0) {
        return difference == 0 ? 0 : 1;
    }
    return difference / norm;
}

}  // namespace relume::lab
