#include "server/net/display_table.h"

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
    thresholds_[0] = 0;
    for (std::size_t code = 1; code < 256; ++code) {
        thresholds_[code] = threshold_of(code, display);
    }
    thresholds_[256] = std::numeric_limits<float>::quiet_NaN();  // nothing reaches it
    // The table begins below the first threshold, where the code is 0, and ends far above the
    // last one, whatever the exposure.
    first_bin_ = std::bit_cast<std::uint32_t>(thresholds_[1]) >> DisplayTables::kBinShift;
    first_bin_ = first_bin_ == 0 ? 0 : first_bin_ - 1;
    std::size_t code = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
        const float lower_end = std::bit_cast<float>(
            static_cast<std::uint32_t>((first_bin_ + bin) << DisplayTables::kBinShift));
        while (code < 255 && lower_end >= thresholds_[code + 1]) {
            ++code;
        }
        codes_[bin] = static_cast<std::uint8_t>(code);
    }
}

void DisplayTable::codes(std::span<const float> linear, std::span<std::uint8_t> codes) const {
    const DisplayTables tables{
        .first_bin = first_bin_, .thresholds = thresholds_.data(), .codes = codes_.data()};
    const std::size_t done =
        write_vectors_of_codes(tables, linear.data(), linear.size(), codes.data());
    std::transform(linear.begin() + static_cast<std::ptrdiff_t>(done), linear.end(),
                   codes.begin() + static_cast<std::ptrdiff_t>(done),
                   [this](float value) { return code(value); });
}

}  // namespace relume::net
