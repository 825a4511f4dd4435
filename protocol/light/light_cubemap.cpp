#include "protocol/light/light_cubemap.h"

#include "protocol/basis/cubemap.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

namespace relume::light {

void LightCubemap::reset(std::uint32_t n) {
    if (!basis::is_face_resolution(n)) {
        throw std::invalid_argument(
            fmt::format("face resolution of a lighting cubemap is {}, expected a power of two "
                        "from {} to {}",
                        n, basis::kMinFaceResolution, basis::kMaxFaceResolution));
    }
    face_resolution = n;
    radiance.assign(3 * basis::texel_count(n), 0.0F);
}

std::array<std::span<float>, 3> LightCubemap::planes() {
    const std::span<float> all(radiance);
    const std::size_t size = plane_size();
    return {all.subspan(0, size), all.subspan(size, size), all.subspan(2 * size, size)};
}

std::array<std::span<const float>, 3> LightCubemap::planes() const {
    const std::span<const float> all(radiance);
    const std::size_t size = plane_size();
    return {all.subspan(0, size), all.subspan(size, size), all.subspan(2 * size, size)};
}

Imath::V3d total_energy(const LightCubemap& cubemap) {
    const std::uint32_t n = cubemap.face_resolution;
    const auto planes = cubemap.planes();
    const std::size_t face_size = std::size_t{n} * n;
    Imath::V3d energy(0);
    for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
            const double solid_angle = basis::solid_angle_sr(n, row, column);
            for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
                const std::size_t texel = face * face_size + std::size_t{row} * n + column;
                energy += solid_angle *
                          Imath::V3d(planes[0][texel], planes[1][texel], planes[2][texel]);
            }
        }
    }
    return energy;
}

void lighting_coefficients(const LightCubemap& cubemap,
                           const basis::CubemapProjection& projection,
                           std::vector<float>& planar_coefficients) {
    if (cubemap.face_resolution != projection.basis().face_resolution()) {
        throw std::invalid_argument(fmt::format(
            "the lighting cubemap has face resolution {}, the projection expects {}",
            cubemap.face_resolution, projection.basis().face_resolution()));
    }
    const std::size_t count = projection.basis().coefficient_count();
    const auto planes = cubemap.planes();
    planar_coefficients.resize(planes.size() * count);
    tbb::parallel_for(std::size_t{0}, planes.size(), [&](std::size_t colour) {
        projection.project_radiance(
            planes[colour], std::span(planar_coefficients).subspan(colour * count, count));
    });
}

}  // namespace relume::light
