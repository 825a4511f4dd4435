#include "protocol/tripling/texel_store.h"

#include "protocol/tripling/texel_blocks.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::tripling {
namespace {

double sum_of_sizes(const std::vector<float>& texels) {
    return std::accumulate(texels.begin(), texels.end(), 0.0,
                           [](double sum, float t) { return sum + std::abs(double{t}); });
}

TEST(TexelStore, KeepsEveryTexelWhereNothingMayBeLeftOff) {
    for (const std::uint32_t n : {4U, 8U, 64U, 256U}) {
        TexelStore store(n);
        const auto first = random_cubemap(n, 1);
        auto second = random_cubemap(n, 2);
        std::fill(second.begin() + static_cast<std::ptrdiff_t>(second.size() / 3), second.end(),
                  0.0F);
        store.append(first, 0);
        store.append(second, 0);
        ASSERT_EQ(store.size(), 2U);
        EXPECT_EQ(store.texels(0), first) << n;
        EXPECT_EQ(store.texels(1), second) << n;
    }
}

TEST(TexelStore, KeepsNoRunOfZeroes) {
    TexelStore store(64);
    std::vector<float> texels(basis::texel_count(64), 0.0F);
    store.append(texels, 0);
    texels[64 * 17 + 5] = 1;
    store.append(texels, 0);
    EXPECT_EQ(values_of_run(store.view(0), 17), nullptr);
    EXPECT_EQ(values_of_run(store.view(1), 16), nullptr);
    ASSERT_NE(values_of_run(store.view(1), 17), nullptr);
    EXPECT_EQ(values_of_run(store.view(1), 17)[5], 1);
    EXPECT_LT(store.byte_count(), 1024U);
}

TEST(TexelStore, LeavesOffNoMoreThanItMay) {
    constexpr std::uint32_t n = 32;
    // Runs of many sizes.
    auto texels = random_cubemap(n, 3);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] *= std::exp2(-static_cast<float>(i / 64 % 16));
    }
    const double whole = sum_of_sizes(texels);
    std::size_t bytes_before = ~std::size_t{0};
    for (const double fraction : {0.0, 1e-4, 1e-2, 0.1}) {
        TexelStore store(n);
        store.append(texels, fraction);
        EXPECT_LE(whole - sum_of_sizes(store.texels(0)), fraction * whole * (1 + 1e-9) + 1e-9);
        EXPECT_LE(store.byte_count(), bytes_before);
        bytes_before = store.byte_count();
    }
    EXPECT_LT(bytes_before, texels.size() * sizeof(float) / 2);
}

TEST(TexelBlocks, HoldEveryTexelOnce) {
    for (const std::uint32_t n : {4U, 8U, 16U, 64U}) {
        std::vector<int> seen(basis::texel_count(n), 0);
        for (std::size_t texel = 0; texel < seen.size(); ++texel) {
            ++seen.at(place_in_blocks(n, texel));
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1),
                  static_cast<std::ptrdiff_t>(seen.size()));
    }
}

TEST(TexelBlocks, AreSquaresOfTheFace) {
    constexpr std::uint32_t n = 32;
    for (std::size_t first = 0; first < n; first += kBlockSide) {
        const std::size_t corner = place_in_blocks(n, 3 * n * n + 8 * n + first);
        EXPECT_EQ(corner % 64, 0U);
        EXPECT_EQ(place_in_blocks(n, 3 * n * n + 10 * n + first + 5), corner + 21);
    }
}

TEST(TexelBlocks, MoveBitsAndValuesAlike) {
    for (const std::uint32_t n : {4U, 8U, 16U, 64U, 256U}) {
        const auto open = random_visibility(n, n);
        const auto bits = bits_of(open);
        std::vector<std::uint64_t> moved(bits.size());
        bits_in_blocks(n, bits, moved);
        EXPECT_EQ(moved, bits_of(values_in_blocks(n, open))) << n;
    }
}

}  // namespace
}  // namespace relume::tripling
