// Which bits of a byte are set: what turns an occupancy into slots.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace relume::engine {

// For each byte: the places of its set bits, ascending; what follows them is without meaning.
using SetBits = std::array<std::array<std::uint8_t, 8>, 256>;

constexpr SetBits make_set_bits() {
    SetBits places{};
    for (std::size_t byte = 0; byte < places.size(); ++byte) {
        std::size_t count = 0;
        for (std::uint8_t bit = 0; bit < 8; ++bit) {
            if (((byte >> bit) & 1U) != 0) {
                places[byte][count++] = bit;
            }
        }
    }
    return places;
}

alignas(64) inline constexpr SetBits kSetBits = make_set_bits();

}  // namespace relume::engine
