#include "protocol/transport/receiver_basis.h"

#include "protocol/basis/haar.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace relume::transport {
namespace {

// Z-order of (x, y), both below 16.
constexpr std::uint32_t interleaved_bits(std::uint32_t x, std::uint32_t y) {
    std::uint32_t z = 0;
    for (std::uint32_t bit = 0; bit < 4; ++bit) {
        z |= ((x >> bit) & 1U) << (2 * bit);
        z |= ((y >> bit) & 1U) << (2 * bit + 1);
    }
    return z;
}

// The place in Mallat's pyramid of the coefficient in every slot.
constexpr std::array<std::uint8_t, kBlockSize> make_pyramid_places() {
    std::array<std::uint8_t, kBlockSize> places{};
    for (std::uint32_t side = 1; side < kTileSide; side *= 2) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t slot = side * side + 3 * interleaved_bits(x, y);
                const std::uint32_t along_columns = y * kTileSide + side + x;
                const std::uint32_t along_rows = (side + y) * kTileSide + x;
                places[slot] = static_cast<std::uint8_t>(along_columns);
                places[slot + 1] = static_cast<std::uint8_t>(along_rows);
                places[slot + 2] = static_cast<std::uint8_t>(along_rows + side);
            }
        }
    }
    return places;
}

constexpr auto kPyramidPlaces = make_pyramid_places();

}  // namespace

void block_coefficients_from_receivers(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> scratch;
    basis::haar_forward(kTileSide, values, scratch);
    std::copy(values.begin(), values.end(), scratch.begin());
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] = scratch[kPyramidPlaces[slot]];
    }
}

void block_receivers_from_coefficients(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> scratch;
    std::copy(values.begin(), values.end(), scratch.begin());
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[kPyramidPlaces[slot]] = scratch[slot];
    }
    basis::haar_inverse(kTileSide, values, scratch);
}

}  // namespace relume::transport
