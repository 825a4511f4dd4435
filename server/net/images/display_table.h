// The display transform of protocol/README.md §3.2 as a table: what wire::code_from_linear
// gives, at the price of one load.
#pragma once

#include "protocol/wire/room_state.h"
#include "server/net/images/display_kernel.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace relume::net {

// The transform rises with its argument, so 255 thresholds say all there is to say. Bins over
// the leading bits of the float are so narrow that at most one threshold falls into any.
class DisplayTable {
  public:
    explicit DisplayTable(const wire::Display& display);

    // NaN and all up to 0 give the code of 0.
    [[nodiscard]] std::uint8_t code(float linear) const {
        if (!(linear > 0)) {
            return 0;
        }
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(linear);
        const std::uint32_t bin = bits >> DisplayBins::kBinShift;
        const std::uint32_t clamped = bin < first_bin_ ? 0 : bin - first_bin_;
        const std::uint32_t entry =
            entries_[clamped < DisplayBins::kBins ? clamped : DisplayBins::kBins - 1];
        return static_cast<std::uint8_t>((entry + (bits & DisplayBins::kLowerBits)) >>
                                         DisplayBins::kBinShift);
    }

    // Interleaved or planar alike; as many codes as values.
    void codes(std::span<const float> linear, std::span<std::uint8_t> codes) const;

  private:
    std::uint32_t first_bin_ = 0;
    std::array<std::uint32_t, DisplayBins::kBins> entries_{};
};

}  // namespace relume::net
