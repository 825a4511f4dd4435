// The lighting cubemap: mean radiance of every texel, by colour.
#pragma once

#include "protocol/basis/cubemap_projection.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::light {

// Planar: 3 planes (red, green, blue) of 6·n² values in the texel order of protocol/basis.
struct LightCubemap {
    std::uint32_t face_resolution = 0;
    std::vector<float> radiance;

    LightCubemap() = default;
    // All black. Throws std::invalid_argument unless basis::is_face_resolution(n).
    explicit LightCubemap(std::uint32_t n) { reset(n); }

    // As made anew with n; keeps the memory.
    void reset(std::uint32_t n);

    [[nodiscard]] std::size_t plane_size() const { return radiance.size() / 3; }
    [[nodiscard]] std::array<std::span<float>, 3> planes();
    [[nodiscard]] std::array<std::span<const float>, 3> planes() const;
};

// ∫ radiance dω per colour.
[[nodiscard]] Imath::V3d total_energy(const LightCubemap& cubemap);

// The coefficients of radiance, planar [3][N] (protocol/README.md §1). The vector is resized.
// Throws std::invalid_argument when the projection is of another resolution.
void lighting_coefficients(const LightCubemap& cubemap,
                           const basis::CubemapProjection& projection,
                           std::vector<float>& planar_coefficients);

}  // namespace relume::light
