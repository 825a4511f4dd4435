// The display transform of protocol/README.md §3.2 as a table: what wire::code_from_linear
// gives, at the price of two loads.
#pragma once

#include "protocol/wire/session_state.h"
#include "server/net/display_kernel.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace relume::net {

// The transform rises with its argument, so 255 thresholds say all there is to say. A table
// over the leading bits of the float finds the code at the lower end of the argument's bin;
// bins are so narrow that at most one threshold falls into any, and one comparison does the
// rest.
class DisplayTable {
  public:
    explicit DisplayTable(const wire::Display& display);

    // NaN and all up to 0 give the code of 0.
    [[nodiscard]] std::uint8_t code(float linear) const {
        if (!(linear > 0)) {
            return 0;
        }
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(linear);
        const std::uint32_t bin = bits >> DisplayTables::kBinShift;
        const std::uint32_t clamped = bin < first_bin_ ? 0 : bin - first_bin_;
        const std::size_t code = codes_[clamped < kBins ? clamped : kBins - 1];
        return static_cast<std::uint8_t>(code + (linear >= thresholds_[code + 1] ? 1 : 0));
    }

    // Interleaved or planar alike; as many codes as values.
    void codes(std::span<const float> linear, std::span<std::uint8_t> codes) const;

  private:
    static constexpr std::size_t kBins = DisplayTables::kBins;

    std::uint32_t first_bin_ = 0;
    std::array<float, 257> thresholds_{};  // the least value that gets this code or more
    std::array<std::uint8_t, kBins + DisplayTables::kCodesTail> codes_{};
};

}  // namespace relume::net
