// Byte shuffles that spread packed values to the set bits of a mask.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::engine {

// For each mask and bit i: the rank of bit i among the set bits, or 0x80 ("zero" to a byte
// shuffle) where it is not set.
using BitmapShuffles = std::array<std::array<std::uint8_t, 8>, 256>;

constexpr BitmapShuffles make_bitmap_shuffles() {
    BitmapShuffles shuffles{};
    for (std::size_t mask = 0; mask < shuffles.size(); ++mask) {
        std::uint8_t rank = 0;
        for (std::size_t bit = 0; bit < 8; ++bit) {
            const bool set = ((mask >> bit) & 1U) != 0;
            shuffles[mask][bit] = set ? rank : 0x80;
            rank = static_cast<std::uint8_t>(rank + (set ? 1 : 0));
        }
    }
    return shuffles;
}

alignas(64) inline constexpr BitmapShuffles kBitmapShuffles = make_bitmap_shuffles();

}  // namespace relume::engine
