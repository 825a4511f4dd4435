// The direct part of a receiver's transport: reflection times visibility, texel by texel.
#pragma once

#include "precompute/bake/receivers/receiver.h"
#include "precompute/bake/rows/reflection.h"
#include "precompute/bake/rows/visibility.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <vector>

namespace relume::bake {

// Response of a receiver to radiance 1 in each texel, row-major. One plane times a colour where
// that says it all, else three planes.
struct TexelRow {
    bool is_grey = true;
    Imath::V3f colour{0, 0, 0};               // of plane[0], when grey
    std::array<std::vector<float>, 3> plane;  // one or three, of 6·n² values
};

class DirectLight {
  public:
    DirectLight(const RayCaster& caster, const LightTexels& texels, std::uint32_t edge_samples);

    // One per thread.
    struct Scratch {
        Reflection reflection;
        Reflection turn;  // of one of several points
        Visibility::Scratch visibility;
        std::vector<float> open;
        std::vector<float> scattered;
    };

    // Depends on nothing but its arguments.
    void compute(const Receiver& receiver,
                 std::uint64_t seed,
                 TexelRow& row,
                 Scratch& scratch) const;

  private:
    void light_surface(const ReceiverSurface& surface,
                       const JitterShift& shift,
                       Scratch& scratch) const;
    void reflect_from_turns(const ReceiverSurface& surface, Scratch& scratch) const;
    void add_split_texels(const ReceiverSurface& surface,
                          const JitterShift& shift,
                          Scratch& scratch) const;

    const RayCaster& caster_;
    const LightTexels& texels_;
    Visibility visibility_;
};

}  // namespace relume::bake
