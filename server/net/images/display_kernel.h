// The inner loop of display_table.h, compiled for several vector widths.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::net {

// The table of a DisplayTable: what a positive float's code is, by its leading bits, which say
// the bin, and those below. Entry (code << kBinShift) + 2^kBinShift − t stands for a bin that
// begins with a code and goes on with the next from the lower bits t on (2^kBinShift if it does
// not): add the lower bits, and the code is above them.
struct DisplayBins {
    // 8 bits of mantissa, 32 powers of two.
    static constexpr std::uint32_t kBinShift = 15;
    static constexpr std::uint32_t kLowerBits = (1U << kBinShift) - 1;
    static constexpr std::size_t kBins = 32 << 8;

    std::uint32_t first_bin;
    const std::uint32_t* entries;  // [kBins]
};

// As many codes as whole vectors of values hold: how many. Of each what DisplayTable::code
// gives.
[[nodiscard]] std::size_t write_vectors_of_codes(const DisplayBins& bins,
                                                 const float* linear,
                                                 std::size_t count,
                                                 std::uint8_t* codes);

}  // namespace relume::net
