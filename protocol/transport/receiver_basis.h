// The basis in which a block's 256 receivers are stored: the orthonormal 2-D Haar basis of its
// 16×16 tile, coefficients where basis/haar.h puts them. Neighbouring pixels see much the same
// of the light, so that most coefficients of a column vanish, where hardly a pixel does; and
// as the image is linear in them, it is summed in this basis and transformed once.
#pragma once

#include "protocol/transport/format.h"

#include <span>

namespace relume::transport {

// In place, slots to coefficients and back.
void block_coefficients_from_receivers(std::span<float, kBlockSize> values);
void block_receivers_from_coefficients(std::span<float, kBlockSize> values);

}  // namespace relume::transport
