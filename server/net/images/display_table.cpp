#include "server/net/images/display_table.h"

#include "protocol/wire/display.h"

#include <algorithm>

namespace relume::net {

namespace {

// The least positive float whose code is at least this one, infinity if there is none. Positive
// floats are ordered as their bits are.
float threshold_of(std::size_t code, const wire::Display& display) {
    std::uint32_t below = 0;
    std::uint32_t above = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
    while (above - below > 1) {
        const std::uint32_t middle = below + (above - below) / 2;
        const bool reached =
            wire::code_from_linear(std::bit_cast<float>(middle), display) >= code;
        (reached ? above : below) = middle;
    }
    return std::bit_cast<float>(above);
}

}  // namespace

DisplayTable::DisplayTable(const wire::Display& display) {
    constexpr std::uint32_t kBinSize = DisplayBins::kLowerBits + 1;
    std::array<std::uint32_t, 257> thresholds{};  // bits of the least value with this code
    for (std::size_t code = 1; code < 256; ++code) {
        thresholds[code] = std::bit_cast<std::uint32_t>(threshold_of(code, display));
    }
    thresholds[256] = ~std::uint32_t{0};  // nothing reaches it
    // The table begins below the first threshold, where the code is 0, and ends far above the
    // last one, whatever the exposure.
    first_bin_ = thresholds[1] >> DisplayBins::kBinShift;
    first_bin_ = first_bin_ == 0 ? 0 : first_bin_ - 1;
    std::uint32_t code = 0;
    for (std::uint32_t bin = 0; bin < DisplayBins::kBins; ++bin) {
        const std::uint32_t lower_end = (first_bin_ + bin) << DisplayBins::kBinShift;
        while (lower_end >= thresholds[code + 1]) {
            ++code;
        }
        const std::uint32_t next = std::min(thresholds[code + 1] - lower_end, kBinSize);
        entries_[bin] = (code << DisplayBins::kBinShift) + kBinSize - next;
    }
}

void DisplayTable::codes(std::span<const float> linear, std::span<std::uint8_t> codes) const {
    const std::size_t done =
        write_vectors_of_codes({.first_bin = first_bin_, .entries = entries_.data()},
                               linear.data(), linear.size(), codes.data());
    std::transform(linear.begin() + static_cast<std::ptrdiff_t>(done), linear.end(),
                   codes.begin() + static_cast<std::ptrdiff_t>(done),
                   [this](float value) { return code(value); });
}

}  // namespace relume::net
