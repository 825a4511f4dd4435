// How much an error in each coefficient of light weighs in the image, under natural light and
// under a lone lit texel (bake/blocks/light_model.h).
#pragma once

#include "protocol/basis/cubemap_basis.h"

#include <cstdint>
#include <vector>

namespace relume::lab {

// A column, and how many it stands for.
struct WeighedColumn {
    std::uint32_t index = 0;
    float weight = 1;
};

struct LightWeights {
    // Variance of natural light's coefficients, [N]; those of its constant have none.
    std::vector<float> variances;
    std::vector<basis::CubemapBasis::Term> constant;
    std::vector<WeighedColumn> all;   // each stands for itself
    std::vector<WeighedColumn> some;  // at most 256 of a band, by which steps are tried
    // A lone texel's coefficients have the same energy in all bands of a Haar basis: in the
    // mean over texels every squared error counts alike.
    explicit LightWeights(const basis::CubemapBasis& basis);
};

}  // namespace relume::lab
