// The basis in which a block's 256 receivers are stored.
//
// haar_tile. Tiles of pixels are stored in the orthonormal 2-D Haar basis of the 16×16 tile.
// Neighbouring pixels see much the same of the light. So most Haar coefficients of a column
// vanish, although hardly any of its pixel values does. The image is linear in the
// coefficients; it is summed in this basis, and each block is transformed back once.
//
// Coefficients lie from the coarsest level to the finest. Slot 0 holds the scaling coefficient.
// Slots 4^ℓ + 3·z(column, row) + 0, 1, 2 hold the wavelets of level ℓ (basis/haar.h) at one
// place: along columns, along rows, along both. Within a level places are in Z-order. Non-zero
// coefficients come in clusters, which fill fewer strips of eight slots in this order than in
// that of the pyramid.
//
// haar_line. Vertices of a surface lie in an order in which neighbours in the line are
// neighbours on the surface, pair by pair, pair of pairs by pair of pairs. They are stored in
// the orthonormal 1-D Haar basis of the 256 slots: slot 0 holds the scaling coefficient, slot
// 2^ℓ + i the i-th wavelet of level ℓ = 0 … 7, which is positive on its first half.
//
// identity. Where a surface is refined until neighbours differ, a mean and a difference hold no
// less than two values do: slot i holds the value of receiver i.
#pragma once

#include "protocol/base/text/name_table.h"
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

// The Z-order of every slot's pixel.
inline constexpr std::array<std::uint8_t, kBlockSize> kZOrder = [] {
    std::array<std::uint8_t, kBlockSize> order{};
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        order[slot] = static_cast<std::uint8_t>(z_order(slot % kTileSide, slot / kTileSide));
    }
    return order;
}();

// Which of the bases below a transport's blocks are stored in.
enum class BlockBasis : std::uint8_t { haar_tile, haar_line, identity };

inline constexpr text::NameTable<BlockBasis, 3> kBlockBasisNames({{
    {BlockBasis::haar_tile, "haar_tile"},
    {BlockBasis::haar_line, "haar_line"},
    {BlockBasis::identity, "identity"},
}});

// From the values of a block's receivers, by slot, to coefficients, and back; in place.
void block_coefficients_from_receivers(BlockBasis basis, std::span<float, kBlockSize> values);
void block_receivers_from_coefficients(BlockBasis basis, std::span<float, kBlockSize> values);

}  // namespace relume::transport
