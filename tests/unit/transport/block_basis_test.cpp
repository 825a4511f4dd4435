#include "protocol/transport/block_basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace relume::transport {
namespace {

using Values = std::array<float, kBlockSize>;

class BlockBasisTest : public testing::TestWithParam<BlockBasis> {};

Values noise(std::uint32_t seed) {
    Values values;
    for (float& value : values) {
        seed = seed * 1664525U + 1013904223U;
        value = static_cast<float>(seed >> 8U) * 0x1p-23F - 1.0F;
    }
    return values;
}

double product(const Values& a, const Values& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

TEST_P(BlockBasisTest, ComesBack) {
    const Values before = noise(1);
    Values values = before;
    block_coefficients_from_receivers(GetParam(), values);
    block_receivers_from_coefficients(GetParam(), values);
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        EXPECT_NEAR(values[slot], before[slot], 1e-6) << slot;
    }
}

TEST_P(BlockBasisTest, KeepsInnerProducts) {
    Values a = noise(1);
    Values b = noise(2);
    const double expected = product(a, b);
    block_coefficients_from_receivers(GetParam(), a);
    block_coefficients_from_receivers(GetParam(), b);
    EXPECT_NEAR(product(a, b), expected, 1e-5);
}

class WaveletBlockBasisTest : public BlockBasisTest {};

TEST_P(WaveletBlockBasisTest, AConstantIsItsFirstCoefficient) {
    Values values;
    values.fill(0.25F);
    block_coefficients_from_receivers(GetParam(), values);
    EXPECT_NEAR(values[0], 4.0F, 1e-5);
    for (std::size_t slot = 1; slot < kBlockSize; ++slot) {
        EXPECT_NEAR(values[slot], 0, 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(
    All,
    BlockBasisTest,
    testing::Values(BlockBasis::haar_tile, BlockBasis::haar_line, BlockBasis::identity),
    [](const auto& shown) { return std::string(kBlockBasisNames.name(shown.param)); });
INSTANTIATE_TEST_SUITE_P(Wavelets,
                         WaveletBlockBasisTest,
                         testing::Values(BlockBasis::haar_tile, BlockBasis::haar_line),
                         [](const auto& shown) {
                             return std::string(kBlockBasisNames.name(shown.param));
                         });

TEST(IdentityBlockBasis, ASlotHoldsItsReceiversValue) {
    const Values before = noise(3);
    Values values = before;
    block_coefficients_from_receivers(BlockBasis::identity, values);
    EXPECT_EQ(values, before);
    block_receivers_from_coefficients(BlockBasis::identity, values);
    EXPECT_EQ(values, before);
}

TEST(HaarLine, SlotsGoFromTheCoarsestLevelToTheFinest) {
    for (std::uint32_t level = 0; level < 8; ++level) {
        for (std::uint32_t place = 0; place < (1U << level); ++place) {
            Values values{};
            values[(1U << level) + place] = 1;
            block_receivers_from_coefficients(BlockBasis::haar_line, values);
            const std::uint32_t width = kBlockSize >> level;
            const auto high = static_cast<float>(1 / std::sqrt(static_cast<double>(width)));
            for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
                const bool inside = slot / width == place;
                const float sign = slot % width < width / 2 ? 1.0F : -1.0F;
                EXPECT_NEAR(values[slot], inside ? sign * high : 0.0F, 1e-6)
                    << level << " " << place << " " << slot;
            }
        }
    }
}

}  // namespace
}  // namespace relume::transport
