// The basis in which a block's 256 receivers are stored.
//
// Of pixel tiles it is the orthonormal 2-D Haar basis of the 16×16 tile. Neighbouring pixels
// see much the same of the light, so that most coefficients of a column vanish, where hardly a
// pixel does; and as the image is linear in them, it is summed in this basis and transformed
// once.
//
// From the coarsest to the finest, the three wavelets of one place side by side, places in
// Z-order: slot 0 holds the scaling coefficient, slots 4^ℓ + 3·z(column, row) + 0, 1, 2 the
// wavelets along columns, along rows and along both of level ℓ (basis/haar.h). What is not zero
// comes in clusters, and so fills fewer strips than in the order of the pyramid.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstdint>
#include <span>

namespace relume::transport {

// Z-order of (column, row), both below 16.
[[nodiscard]] constexpr std::uint32_t z_order(std::uint32_t column, std::uint32_t row) {
    std::uint32_t z = 0;
    for (std::uint32_t bit = 0; bit < 4; ++bit) {
        z |= ((column >> bit) & 1U) << (2 * bit);
        z |= ((row >> bit) & 1U) << (2 * bit + 1);
    }
    return z;
}

// Of every slot.
inline constexpr std::array<std::uint8_t, kBlockSize> kZOrder = [] {
    std::array<std::uint8_t, kBlockSize> order{};
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        order[slot] = static_cast<std::uint8_t>(z_order(slot % kTileSide, slot / kTileSide));
    }
    return order;
}();

// Which of the bases below a transport's blocks are stored in.
enum class BlockBasis : std::uint8_t { haar_tile };

// In place, slots to coefficients of haar_tile and back.
void block_coefficients_from_receivers(std::span<float, kBlockSize> values);
void block_receivers_from_coefficients(std::span<float, kBlockSize> values);

}  // namespace relume::transport
