// The basis in which a block's 256 receivers are stored: the orthonormal 2-D Haar basis of its
// 16×16 tile. Neighbouring pixels see much the same of the light, so that most coefficients of
// a column vanish, where hardly a pixel does; and as the image is linear in them, it is summed
// in this basis and transformed once.
//
// From the coarsest to the finest, the three wavelets of one place side by side, places in
// Z-order: slot 0 holds the scaling coefficient, slots 4^ℓ + 3·z(column, row) + 0, 1, 2 the
// wavelets along columns, along rows and along both of level ℓ (basis/haar.h). What is not zero
// comes in clusters, and so fills fewer strips than in the order of the pyramid.
#pragma once

#include "protocol/transport/format.h"

#include <span>

namespace relume::transport {

// In place, slots to coefficients and back.
void block_coefficients_from_receivers(std::span<float, kBlockSize> values);
void block_receivers_from_coefficients(std::span<float, kBlockSize> values);

}  // namespace relume::transport
