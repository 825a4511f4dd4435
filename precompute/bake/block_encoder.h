// The 256 receivers of a block, gathered row by row and encoded column by column.
#pragma once

#include "protocol/transport/quantise.h"
#include "protocol/transport/shard_writer.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relume::bake {

// Rows may be set by several threads at once, each slot by one.
class BlockEncoder {
  public:
    // Non-zero values of one receiver, in any order.
    [[nodiscard]] std::vector<transport::QuantisedValue>& row(std::uint32_t slot) {
        return rows_[slot];
    }
    // Encodes `segments` = N·K cells.
    [[nodiscard]] transport::EncodedBlock encode(std::size_t segments) const;

  private:
    std::array<std::vector<transport::QuantisedValue>, transport::kBlockSize> rows_;
};

}  // namespace relume::bake
