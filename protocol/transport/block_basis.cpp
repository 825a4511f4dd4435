#include "protocol/transport/block_basis.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/basis/haar.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace relume::transport {
namespace {

// The place in Mallat's pyramid of the coefficient in every slot.
constexpr std::array<std::uint8_t, kBlockSize> make_pyramid_places() {
    std::array<std::uint8_t, kBlockSize> places{};
    for (std::uint32_t side = 1; side < kTileSide; side *= 2) {
        for (std::uint32_t y = 0; y < side; ++y) {
            for (std::uint32_t x = 0; x < side; ++x) {
                const std::uint32_t slot = side * side + 3 * z_order(x, y);
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

void tile_coefficients_from_receivers(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> scratch;
    basis::haar_forward(kTileSide, values, scratch);
    std::copy(values.begin(), values.end(), scratch.begin());
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] = scratch[kPyramidPlaces[slot]];
    }
}

// One level finer: the four children of a place stand where its Z-order says.
RELUME_CPU_CLONES void refine(const float* __restrict averages,
                              const float* __restrict wavelets,
                              std::size_t places,
                              float* __restrict finer) {
    for (std::size_t z = 0; z < places; ++z) {
        const float a = averages[z];
        const float h = wavelets[3 * z];
        const float v = wavelets[3 * z + 1];
        const float d = wavelets[3 * z + 2];
        finer[4 * z] = 0.5F * ((a + h) + (v + d));
        finer[4 * z + 1] = 0.5F * ((a - h) + (v - d));
        finer[4 * z + 2] = 0.5F * ((a + h) - (v + d));
        finer[4 * z + 3] = 0.5F * ((a - h) - (v - d));
    }
}

void tile_receivers_from_coefficients(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> receivers;  // in Z-order
    std::array<float, kBlockSize / 4> coarser;
    coarser[0] = values[0];
    refine(coarser.data(), &values[1], 1, receivers.data());
    for (std::size_t places = 4; places < kBlockSize; places *= 4) {
        std::copy_n(receivers.begin(), places, coarser.begin());
        refine(coarser.data(), &values[places], places, receivers.data());
    }
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        values[slot] = receivers[kZOrder[slot]];
    }
}

constexpr float kHalfRoot = 0x1.6a09e6p-1F;  // √½

void line_coefficients_from_receivers(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> coefficients;
    for (std::size_t pairs = kBlockSize / 2; pairs > 0; pairs /= 2) {
        for (std::size_t i = 0; i < pairs; ++i) {
            coefficients[pairs + i] = kHalfRoot * (values[2 * i] - values[2 * i + 1]);
        }
        for (std::size_t i = 0; i < pairs; ++i) {
            values[i] = kHalfRoot * (values[2 * i] + values[2 * i + 1]);
        }
    }
    std::copy(coefficients.begin() + 1, coefficients.end(), values.begin() + 1);
}

RELUME_CPU_CLONES void line_receivers_from_coefficients(std::span<float, kBlockSize> values) {
    std::array<float, kBlockSize> finer;
    std::array<float, kBlockSize> coarser;
    coarser[0] = values[0];
    for (std::size_t pairs = 1; pairs < kBlockSize; pairs *= 2) {
        for (std::size_t i = 0; i < pairs; ++i) {
            finer[2 * i] = kHalfRoot * (coarser[i] + values[pairs + i]);
            finer[2 * i + 1] = kHalfRoot * (coarser[i] - values[pairs + i]);
        }
        std::copy_n(finer.begin(), 2 * pairs, coarser.begin());
    }
    std::copy(coarser.begin(), coarser.end(), values.begin());
}

}  // namespace

void block_coefficients_from_receivers(BlockBasis basis, std::span<float, kBlockSize> values) {
    switch (basis) {
        case BlockBasis::haar_tile:
            return tile_coefficients_from_receivers(values);
        case BlockBasis::haar_line:
            return line_coefficients_from_receivers(values);
        case BlockBasis::identity:
            return;
    }
}

void block_receivers_from_coefficients(BlockBasis basis, std::span<float, kBlockSize> values) {
    switch (basis) {
        case BlockBasis::haar_tile:
            return tile_receivers_from_coefficients(values);
        case BlockBasis::haar_line:
            return line_receivers_from_coefficients(values);
        case BlockBasis::identity:
            return;
    }
}

}  // namespace relume::transport
