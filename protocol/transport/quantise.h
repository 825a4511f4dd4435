// Quantisation with random rounding, so that what is lost in one pixel is not lost in its
// neighbours too: errors turn from bands into fine noise.
//
// q = ⌊v/step + u⌋ with u uniform in [0,1) by hash of (receiver, column), so E[q] = v/step;
// |v| < step/2 becomes 0, which keeps sparse what is sparse. `column` is j·K + k and a receiver
// is block·256 + slot. Values are finite; step > 0. Saturates at ±2^30.
#pragma once

#include "protocol/transport/cell.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

// The 256 receivers of a block in one column.
void quantise_cell(std::span<const float, kBlockSize> values,
                   float step,
                   std::uint64_t first_receiver,
                   std::uint64_t column,
                   QuantisedCell& quantised);

struct QuantisedValue {
    std::uint32_t column = 0;
    std::int32_t value = 0;  // not zero
};

// One receiver's values in channel k of K, for all coefficients j; gives the same integers as
// quantise_cell. Appends those that are not zero, in ascending order of column.
// `inverse_steps` holds 1/step.
void quantise_row(std::span<const float> values,
                  std::span<const float> inverse_steps,
                  std::uint64_t receiver,
                  std::uint32_t channel,
                  std::uint32_t channels,
                  std::vector<QuantisedValue>& quantised);

}  // namespace relume::transport
