// From escapes to wavelet coefficients, keeping what stands clear of its own noise.
//
// A path-traced row is a handful of spikes; its Haar transform is dense and mostly noise. The
// variance of each coefficient is known from the spikes it is made of. The three wavelets of
// the four squares of a parent, twelve coefficients, are multiplied by one factor: the
// non-negative garrote max(0, 1 − t²·Σσ²/Σ|estimate|²) [Gao98] of the group [Cai99]. Smooth
// interreflection then lives in coarse wavelets alone, and a caustic keeps its fine ones. A
// coefficient by itself would have to stand further clear of its noise: twelve tell noise from
// light more surely than one, so that less light is taken for noise. The scaling coefficients
// are left as they are, so no energy is lost on any face.
#pragma once

#include "precompute/bake/rows/escape_sum.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::bake {

struct Coefficient {
    std::uint32_t index = 0;  // basis/haar.h
    Imath::V3f value{0, 0, 0};
};

// Appends the non-zero coefficients of the sum. `standard_errors` is t; 0 keeps everything.
// Leaves nothing of use in `escapes`.
void project_with_shrinkage(EscapeSum& escapes,
                            float standard_errors,
                            std::vector<Coefficient>& coefficients);

}  // namespace relume::bake
