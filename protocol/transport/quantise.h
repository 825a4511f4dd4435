// Quantisation of one cell with random rounding, so that what is lost in one pixel is not lost
// in its neighbours too: errors turn from bands into fine noise.
#pragma once

#include "protocol/transport/cell.h"

#include <cstdint>
#include <span>

namespace relume::transport {

// q = ⌊v/step + u⌋ with u uniform in [0,1) by hash of (receiver, column), so E[q] = v/step;
// |v| < step/2 becomes 0, which keeps sparse what is sparse. `first_receiver` is
// block·256 and `column` is j·K + k. Values are finite; step > 0. Saturates at ±2^30.
void quantise_cell(std::span<const float, kBlockSize> values,
                   float step,
                   std::uint64_t first_receiver,
                   std::uint64_t column,
                   QuantisedCell& quantised);

}  // namespace relume::transport
