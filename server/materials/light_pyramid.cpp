#include "server/materials/light_pyramid.h"

#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::materials {

LightPyramid::LightPyramid(const light::LightCubemap& cubemap) {
    Level finest{.face_resolution = cubemap.face_resolution, .radiance = {}};
    const auto planes = cubemap.planes();
    for (std::size_t texel = 0; texel < cubemap.plane_size(); ++texel) {
        finest.radiance.emplace_back(planes[0][texel], planes[1][texel], planes[2][texel]);
    }
    levels_.push_back(std::move(finest));
    while (levels_.back().face_resolution > 1) {
        const Level& fine = levels_.back();
        const std::uint32_t n = fine.face_resolution / 2;
        Level coarse{.face_resolution = n, .radiance = {}};
        for (std::size_t row = 0; row < std::size_t{basis::kFaceCount} * n; ++row) {
            for (std::size_t column = 0; column < n; ++column) {
                const Imath::V3f* const above = &fine.radiance[(2 * row * 2 * n) + 2 * column];
                const Imath::V3f* const below = above + std::size_t{2} * n;
                coarse.radiance.push_back((above[0] + above[1] + below[0] + below[1]) * 0.25F);
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

Imath::V3f LightPyramid::radiance(const Imath::V3f& direction, float solid_angle_sr) const {
    const auto n = static_cast<float>(levels_.front().face_resolution);
    const float texels =
        solid_angle_sr * basis::kFaceCount * n * n / (4 * std::numbers::pi_v<float>);
    const float octaves = 0.5F * std::log2(std::max(texels, 1.0F));
    const Level& level =
        levels_[std::min(static_cast<std::size_t>(octaves + 0.5F), levels_.size() - 1)];
    return level.radiance[basis::index_from_texel(
        level.face_resolution, basis::texel_from_direction(level.face_resolution, direction))];
}

}  // namespace relume::materials
