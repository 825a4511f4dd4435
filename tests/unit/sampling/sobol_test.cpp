#include "protocol/sampling/sobol.h"

#include <gtest/gtest.h>

#include <set>

namespace relume::sampling {
namespace {

TEST(Sobol, EveryAlignedRunOfSixteenFillsAllElementaryIntervals) {
    for (std::uint64_t key = 0; key < 20; ++key) {
        for (std::uint32_t run = 0; run < 8; ++run) {
            for (std::uint32_t columns = 1; columns <= 16; columns *= 2) {
                const std::uint32_t rows = 16 / columns;
                std::set<std::uint32_t> cells;
                for (std::uint32_t i = 0; i < 16; ++i) {
                    const Imath::V2f p = sobol_point(run * 16 + i, key);
                    cells.insert(static_cast<std::uint32_t>(p.y * static_cast<float>(rows)) *
                                     columns +
                                 static_cast<std::uint32_t>(p.x * static_cast<float>(columns)));
                }
                EXPECT_EQ(cells.size(), 16U) << key << ' ' << run << ' ' << columns;
            }
        }
    }
}

TEST(Sobol, KeysAreIndependent) {
    // The mean of a product over many keys is the product of the means.
    double product = 0;
    constexpr int kKeys = 20000;
    for (std::uint64_t key = 0; key < kKeys; ++key) {
        product += (sobol_point(5, key).x - 0.5) * (sobol_point(5, key + 1).x - 0.5);
    }
    EXPECT_NEAR(product / kKeys, 0, 5 / 12.0 / std::sqrt(kKeys));
}

TEST(Sobol, MortonIndicesComeApartAgain) {
    for (std::uint32_t x = 0; x < 40; ++x) {
        for (std::uint32_t y = 0; y < 40; ++y) {
            const std::uint32_t morton = morton_index(x, y);
            EXPECT_EQ(morton_even(morton), x);
            EXPECT_EQ(morton_even(morton >> 1U), y);
        }
    }
    EXPECT_EQ(reversed_bits(1), 0x80000000U);
}

}  // namespace
}  // namespace relume::sampling
