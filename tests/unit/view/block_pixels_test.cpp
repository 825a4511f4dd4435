#include "server/view/block_pixels.h"

#include "protocol/transport/block_basis.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace relume::view {
namespace {

using transport::kBlockSize;
using transport::kColours;
using transport::kTileSide;

using BlockValues = std::array<std::array<float, kBlockSize>, kColours>;

BlockValues random_values(std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<float> normal;
    BlockValues values;
    for (auto& plane : values) {
        for (float& value : plane) {
            value = normal(generator);
        }
    }
    return values;
}

// Whole tiles, and all those that an image's edge can cut, wherever in memory they begin: every
// pixel is that of the specification to the last bit, and nothing beside the tile is written.
TEST(BlockPixels, AreTheReceiversTimesTint) {
    constexpr std::size_t kRowFloats = 3 * 40;
    constexpr float kUntouched = -77;
    for (std::uint32_t size = 0; size < kBlockSize; ++size) {
        const std::uint32_t columns = size % kTileSide + 1;
        const std::uint32_t rows = size / kTileSide + 1;
        const std::size_t left = (columns + rows) % 17;  // pixels before the tile
        const BlockValues sums = random_values(columns);
        const BlockValues tint = random_values(rows + 100);
        std::vector<float> image(kRowFloats * 18, kUntouched);
        write_block_pixels(sums[0].data(), tint[0].data(),
                           {.first = &image[kRowFloats + 3 * left],
                            .row_floats = kRowFloats,
                            .columns = columns,
                            .rows = rows});
        BlockValues receivers = sums;
        for (auto& plane : receivers) {
            transport::block_receivers_from_coefficients(transport::BlockBasis::haar_tile,
                                                         plane);
        }
        for (std::size_t y = 0; y < 18; ++y) {
            for (std::size_t x = 0; x < 40; ++x) {
                const bool inside = y >= 1 && y < 1 + rows && x >= left && x < left + columns;
                const std::size_t slot = inside ? (y - 1) * kTileSide + x - left : 0;
                for (std::size_t c = 0; c < kColours; ++c) {
                    const float expected =
                        inside ? receivers[c][slot] * tint[c][slot] : kUntouched;
                    ASSERT_EQ(image[y * kRowFloats + 3 * x + c], expected)
                        << columns << "x" << rows << " at " << x << ", " << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace relume::view
