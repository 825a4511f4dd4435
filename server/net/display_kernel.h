// The inner loop of display_table.h, compiled for several vector widths.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::net {

// The tables of a DisplayTable.
struct DisplayTables {
    // 8 bits of mantissa, 32 powers of two.
    static constexpr std::uint32_t kBinShift = 15;
    static constexpr std::size_t kBins = 32 << 8;
    // Bytes beyond the last code that may be read.
    static constexpr std::size_t kCodesTail = 3;

    std::uint32_t first_bin;
    const float* thresholds;    // [257]
    const std::uint8_t* codes;  // [kBins + kCodesTail]
};

// As many codes as whole vectors of values hold: how many. Of each what DisplayTable::code
// gives.
[[nodiscard]] std::size_t write_vectors_of_codes(const DisplayTables& tables,
                                                 const float* linear,
                                                 std::size_t count,
                                                 std::uint8_t* codes);

}  // namespace relume::net
