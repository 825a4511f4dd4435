// What refinement asks of the light: how a point of the surface answers to it.
#pragma once

#include "precompute/bake/rays/ray_caster.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::bake {

struct ProbePoint {
    Imath::V3f position{0, 0, 0};
    Imath::V3f normal{0, 1, 0};  // interpolated, unit
    std::uint32_t material = 0;  // of Scene::materials
    // Where rays leave the surface around the point, just off it.
    std::array<Imath::V3f, kPacketSize> origins{};
};

class SurfaceProbe {
  public:
    SurfaceProbe() = default;
    SurfaceProbe(const SurfaceProbe&) = delete;
    SurfaceProbe& operator=(const SurfaceProbe&) = delete;
    virtual ~SurfaceProbe() = default;

    // Numbers in a row, at least one.
    [[nodiscard]] virtual std::size_t row_size() const = 0;
    // Writes the row of a point, linear in what the point answers to light, and returns how
    // many rays that took. The squared length of a row, and of a difference of two, is the mean
    // square of what it makes in an image under the lights that the probe stands for. Depends
    // on nothing but the point; thread-safe.
    virtual std::uint64_t write_row(const ProbePoint& point, std::span<float> row) const = 0;
};

}  // namespace relume::bake
