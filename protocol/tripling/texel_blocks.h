// Texels of a cubemap in squares of 8×8, so that what is near on the sphere is near in memory:
// a word of bits, or a run of 64 values, is a square.
//
// Texel (row, column) of a face of n ≥ 8 is at face·n² + 64·((row div 8)·n/8 + column div 8) +
// 8·(row mod 8) + column mod 8; with n = 4 texels keep the order of cubemap.h.
#pragma once

#include "protocol/basis/cubemap.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::tripling {

inline constexpr std::uint32_t kBlockSide = 8;

// Where a texel of cubemap.h's order is among those in squares.
[[nodiscard]] constexpr std::size_t place_in_blocks(std::uint32_t n, std::size_t texel) {
    if (n < kBlockSide) {
        return texel;
    }
    const std::size_t row = texel / n % n;
    const std::size_t column = texel % n;
    const std::size_t block = row / kBlockSide * (n / kBlockSide) + column / kBlockSide;
    return texel / n / n * n * n + 64 * block + row % kBlockSide * kBlockSide +
           column % kBlockSide;
}

// 6·n² values, and zeroes up to a multiple of 64.
[[nodiscard]] std::vector<float> values_in_blocks(std::uint32_t n,
                                                  std::span<const float> texels);
// ⌈6·n²/64⌉ words of bits from as many; the two do not overlap.
void bits_in_blocks(std::uint32_t n,
                    std::span<const std::uint64_t> bits,
                    std::span<std::uint64_t> in_blocks);

}  // namespace relume::tripling
