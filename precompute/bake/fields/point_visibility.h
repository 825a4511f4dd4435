// What a point sees of the light: one ray for each texel of a cubemap, one bit for each ray.
//
// A ray goes in a direction that is random within the part of its texel that lies above the
// point's geometric surface; a texel without such a part is not seen. The rays of a square of
// 4×4 texels leave from sixteen places, so that the bits of a point are those of all that it
// stands for. They are the first rays of a receiver's row (rows/visibility.h) where texels,
// places and shift are the same.
//
// Points that stand for one surface look again only where a shadow's edge passes: elsewhere
// they see what the first of them sees.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/rows/jitter_shift.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/shadow_edges.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// A point as it looks around.
struct LookingPoint {
    std::array<Imath::V3f, kPacketSize> origins{};  // just off the surface
    Imath::V3f geometric_normal{0, 0, 1};           // unit, on the side it looks to
    JitterShift shift;
    // It stands for the same surface as the point before it, from the same places.
    bool looks_again = false;
};

// Keeps references to both. const members are thread-safe.
class PointVisibility {
  public:
    PointVisibility(const RayCaster& caster, const LightTexels& texels)
        : caster_(caster), texels_(texels) {}

    // Reused from point to point; one per thread.
    struct Scratch {
        ShadowEdges edges;                // of the last point that did not look again
        std::vector<std::uint64_t> bits;  // its
        std::vector<std::uint32_t> edge_texels;
        std::uint64_t rays = 0;  // cast so far
    };

    // Writes transport::words_of_visibility(n) words as visibility_field.h has them. A point
    // that looks again follows, with the same scratch, those of its surface.
    void compute(const LookingPoint& point,
                 std::span<std::uint64_t> bits,
                 Scratch& scratch) const;

  private:
    void look(const LookingPoint& point, std::span<std::uint64_t> bits, Scratch& scratch) const;
    void look_again(const LookingPoint& point,
                    std::span<std::uint64_t> bits,
                    Scratch& scratch) const;
    // Aims the lanes whose texels have a part above the surface, and returns their bits.
    [[nodiscard]] std::uint32_t aim(const LookingPoint& point,
                                    std::size_t packet,
                                    RayPacket& rays) const;

    const RayCaster& caster_;
    const LightTexels& texels_;
};

}  // namespace relume::bake
