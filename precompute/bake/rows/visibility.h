// How much of each texel of the light the surface in a receiver sees.
//
// One ray through every texel the surface could be lit from, jittered within the texel, from
// one of sixteen places of the surface; where the four texels beside a texel disagree a
// shadow's edge passes in the light or in the receiver, and more rays follow, from several of
// the places. Half as many follow where the four agree and the 24 around it do not: what shows
// in a few of the places alone is missed by four rays out of sixteen. Which texels get more is
// decided by their neighbours alone, never by their own ray, so the estimate stays unbiased;
// the rays of one texel are stratified over it.
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

class Visibility {
  public:
    // `edge_samples`: further rays per texel at shadow edges, at most.
    Visibility(const RayCaster& caster, const LightTexels& texels, std::uint32_t edge_samples);

    // Reused from point to point; one per thread.
    struct Scratch {
        ShadowEdges edges;
        std::vector<std::uint32_t> places;  // of edges of one kind
        std::array<std::vector<float>, 3> directions;
        std::uint64_t rays = 0;  // cast so far
    };

    // Writes open[place] in [0, 1] wherever wanted[place] ≠ 0; zero elsewhere. A texel at a
    // shadow edge gets the part `share`, in (0, 1], of the further rays, rounded up. `share` is
    // that of the surface in its receiver: the less the surface fills, the less its error
    // weighs.
    void compute(const std::array<Imath::V3f, kPacketSize>& origins,
                 float share,
                 const JitterShift& shift,
                 std::span<const float> wanted,
                 std::span<float> open,
                 Scratch& scratch) const;

  private:
    void cast_first(RayPacket& packet,
                    const JitterShift& shift,
                    std::span<const float> wanted,
                    std::span<float> open,
                    Scratch& scratch) const;
    // ⌈most⌉ further rays for each of the texels.
    void refine(RayPacket& packet,
                const JitterShift& shift,
                std::span<const std::uint32_t> edges,
                float most,
                std::span<float> open,
                Scratch& scratch) const;
    void aim_at_edges(const JitterShift& shift,
                      std::span<const std::uint32_t> edges,
                      std::size_t extra,
                      Scratch& scratch) const;
    void cast_at_edges(RayPacket& packet,
                       std::span<const std::uint32_t> edges,
                       std::size_t extra,
                       std::span<float> open,
                       Scratch& scratch) const;

    const RayCaster& caster_;
    const LightTexels& texels_;
    // Of the further rays: offsets from the first, modulo the texel.
    std::vector<float> column_samples_;
    std::vector<float> row_samples_;
};

}  // namespace relume::bake
