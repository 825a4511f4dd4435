// How far below zero the tables of a factored BRDF reach.
#pragma once

#include "protocol/brdf/factored_brdf.h"

#include <Imath/ImathVec.h>

#include <span>

namespace relume::factors {

struct NegativePart {
    double largest = 0;      // of one colour, in 1/sr, not negative
    double mean_square = 0;  // over both hemispheres, cosine-weighted, and the three colours
};

// Looks at 2¹⁵ pairs of directions that fill the two hemispheres evenly.
[[nodiscard]] NegativePart negative_part(const brdf::FactoredBrdf& brdf,
                                         std::span<const Imath::V3f> colours);

}  // namespace relume::factors
