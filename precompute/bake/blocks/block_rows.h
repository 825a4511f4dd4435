// The float rows of a block's 256 receivers, gathered before they are encoded column by column.
#pragma once

#include "protocol/transport/format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// K rows of N values per receiver: 256·K·N floats, 25 MB a channel at n = 64. Reused from block
// to block. Not thread-safe.
class BlockRows {
  public:
    BlockRows(std::size_t columns, std::uint32_t channels)
        : columns_(columns),
          stride_(columns + kPadding),
          channels_(channels),
          values_(transport::kBlockSize * channels * stride_) {}

    // Forgets all rows.
    void clear() { present_.fill(false); }
    // Copies one receiver's row of channel k, N values.
    void set(std::uint32_t slot, std::uint32_t channel, std::span<const float> row) {
        present_[slot] = true;
        std::copy(row.begin(), row.end(), &values_[first(slot, channel)]);
    }

    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::uint32_t channels() const { return channels_; }
    // Receivers with a row.
    [[nodiscard]] std::size_t present_count() const {
        return static_cast<std::size_t>(std::count(present_.begin(), present_.end(), true));
    }
    // Null for a receiver without a row.
    [[nodiscard]] const float* row(std::uint32_t slot, std::uint32_t channel) const {
        return present_[slot] ? &values_[first(slot, channel)] : nullptr;
    }

  private:
    // Rows a power of two apart would share few sets of the cache.
    static constexpr std::size_t kPadding = 16;

    [[nodiscard]] std::size_t first(std::uint32_t slot, std::uint32_t channel) const {
        return (std::size_t{channel} * transport::kBlockSize + slot) * stride_;
    }

    std::size_t columns_;
    std::size_t stride_;
    std::uint32_t channels_;
    std::array<bool, transport::kBlockSize> present_{};
    std::vector<float> values_;
};

}  // namespace relume::bake
