// Radiance of vertices that does not come from the terms of a transport.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace relume::view {

// Some materials of a surface are given what their vertices send to the viewer. Of the others
// the transport has terms. Of one view: what a vertex sends depends on where it is seen from.
class GivenRadiance {
  public:
    GivenRadiance() = default;
    GivenRadiance(const GivenRadiance&) = delete;
    GivenRadiance& operator=(const GivenRadiance&) = delete;
    virtual ~GivenRadiance() = default;

    // Whether the vertices of the surface's material of this number are given their radiance.
    [[nodiscard]] virtual bool is_given(std::uint32_t material) const = 0;
    // Red, green and blue, [vertices]; of vertices of other materials it is not looked at.
    [[nodiscard]] virtual std::span<const std::array<float, 3>> radiance() const = 0;

    // Rises whenever is_given may answer differently.
    [[nodiscard]] virtual std::uint64_t materials_version() const = 0;
    // Rises whenever radiances may have changed.
    [[nodiscard]] virtual std::uint64_t radiance_version() const = 0;
};

}  // namespace relume::view
