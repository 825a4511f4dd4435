// How much of each texel of the light a point sees.
//
// One ray through every texel the point could be lit from, jittered within the texel; where the
// neighbours of a texel disagree a shadow's edge passes, and more rays follow. Which texels get
// more is decided by their neighbours alone, never by their own ray, so the estimate stays
// unbiased; the rays of one texel are stratified over it.
#pragma once

#include "precompute/bake/light_texels.h"
#include "precompute/bake/ray_caster.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Moves the jitter of a point's texels, each part in [0, 1). One pair for each place of a
// packet: texels that are neighbours are moved independently of each other.
struct JitterShift {
    std::array<float, kPacketSize> column{};
    std::array<float, kPacketSize> row{};
};

class Visibility {
  public:
    // `edge_samples`: further rays per texel at shadow edges.
    Visibility(const RayCaster& caster, const LightTexels& texels, std::uint32_t edge_samples);

    // Reused from point to point; one per thread.
    struct Scratch {
        std::vector<std::uint8_t> state;  // by texel, with a border round each face
        std::vector<std::uint32_t> edges;
        std::uint64_t rays = 0;  // cast so far
    };

    // Writes open[place] in [0, 1] wherever wanted[place] ≠ 0; zero elsewhere.
    void compute(const Imath::V3f& origin,
                 const JitterShift& shift,
                 std::span<const float> wanted,
                 std::span<float> open,
                 Scratch& scratch) const;

  private:
    void cast_first(const Imath::V3f& origin,
                    const JitterShift& shift,
                    std::span<const float> wanted,
                    std::span<float> open,
                    Scratch& scratch) const;
    void find_edges(Scratch& scratch) const;
    void refine_edges(const Imath::V3f& origin,
                      const JitterShift& shift,
                      std::span<float> open,
                      Scratch& scratch) const;
    [[nodiscard]] Imath::V3f direction(std::size_t place,
                                       const JitterShift& shift,
                                       std::uint32_t sample) const;

    const RayCaster& caster_;
    const LightTexels& texels_;
    std::vector<Imath::V2f> samples_;  // offsets from the first ray, modulo the texel
};

}  // namespace relume::bake
