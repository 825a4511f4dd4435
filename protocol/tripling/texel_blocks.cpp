#include "protocol/tripling/texel_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace relume::tripling {

// Eight texels of a row are a byte of a word.
static_assert(std::endian::native == std::endian::little);

std::vector<float> values_in_blocks(std::uint32_t n, std::span<const float> texels) {
    std::vector<float> values((texels.size() + 63) / 64 * 64, 0.0F);
    for (std::size_t texel = 0; texel < texels.size(); ++texel) {
        values[place_in_blocks(n, texel)] = texels[texel];
    }
    return values;
}

void bits_in_blocks(std::uint32_t n,
                    std::span<const std::uint64_t> bits,
                    std::span<std::uint64_t> in_blocks) {
    if (n < kBlockSide) {
        std::copy(bits.begin(), bits.end(), in_blocks.begin());
        return;
    }
    const std::span<const std::byte> from = std::as_bytes(bits);
    const std::span<std::byte> to = std::as_writable_bytes(in_blocks);
    const std::size_t blocks = n / kBlockSide;  // along a side, and bytes of a row
    for (std::size_t row = 0; row < basis::kFaceCount * n; ++row) {
        for (std::size_t column = 0; column < blocks; ++column) {
            // Rows of all faces follow one another, and so do their blocks.
            const std::size_t block = row / kBlockSide * blocks + column;
            to[8 * block + row % kBlockSide] = from[row * blocks + column];
        }
    }
}

}  // namespace relume::tripling
