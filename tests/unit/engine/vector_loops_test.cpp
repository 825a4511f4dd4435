#include "server/engine/kernels/vector_loops.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace relume::engine {
namespace {

template <typename Float>
class AddRows : public testing::Test {};

// Floats in the widest vector, of 512 bits.
constexpr std::size_t kMostLanes = 16;

std::vector<std::size_t> lengths() {
    std::vector<std::size_t> lengths(4 * kMostLanes + 4);
    std::iota(lengths.begin(), lengths.end(), 1UL);
    lengths.insert(lengths.end(), {255, 256, 301});
    return lengths;
}

template <typename Float>
bool is_untouched(Float value) {
    return value == Float{0.75};
}

using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(AddRows, Floats);

// The bits of the plain loop on every instruction set this processor has, for every length
// up to beyond a vector and some longer ones, at every misalignment of the sums, rows given
// twice and none at all.
TYPED_TEST(AddRows, GivesTheBitsOfThePlainLoopOnEveryTarget) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> value(-128, 127);
    std::vector<std::int8_t> table(5000);
    for (std::int8_t& entry : table) {
        entry = static_cast<std::int8_t>(value(random));
    }
    for (const std::size_t length : lengths()) {
        for (const std::size_t count : {0UL, 1UL, 2UL, 13UL}) {
            std::vector<WeightedRow> rows;
            for (std::size_t i = 0; i < count; ++i) {
                rows.push_back({.first = (i / 2 * 97) % (table.size() - length),
                                .weight = 0.37F * static_cast<float>(value(random))});
            }
            std::vector<TypeParam> expected(length, TypeParam{0.75});
            for (const WeightedRow& row : rows) {
                for (std::size_t i = 0; i < length; ++i) {
                    expected[i] =
                        std::fma(static_cast<TypeParam>(row.weight),
                                 static_cast<TypeParam>(table[row.first + i]), expected[i]);
                }
            }
            for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
                hwy::SetSupportedTargetsForTest(target);
                hwy::GetChosenTarget().DeInit();
                for (std::size_t misalignment = 0; misalignment < kMostLanes; ++misalignment) {
                    // One more behind: nothing beside the sums is written.
                    std::vector<TypeParam> sums(misalignment + length + 1, TypeParam{0.75});
                    add_rows(table, rows, std::span(sums).subspan(misalignment, length));
                    const auto first = sums.begin() + static_cast<std::ptrdiff_t>(misalignment);
                    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), first))
                        << count << " rows of " << length << ", " << misalignment
                        << " values off, on " << hwy::TargetName(target);
                    EXPECT_TRUE(std::all_of(sums.begin(), first, is_untouched<TypeParam>));
                    EXPECT_TRUE(is_untouched(sums.back()));
                }
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
        }
    }
}

TEST(SquaredNorm, IsThatOfDoublesToThreeDigits) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> uniform(-2, 2);
    for (const std::size_t length : lengths()) {
        for (std::size_t misalignment = 0; misalignment < kMostLanes; ++misalignment) {
            // What lies beside the values would show.
            std::vector<float> values(misalignment + length + 1, 1e4F);
            const auto counted = std::span(values).subspan(misalignment, length);
            double expected = 0;
            for (float& value : counted) {
                value = uniform(random);
                expected += double{value} * double{value};
            }
            for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
                hwy::SetSupportedTargetsForTest(target);
                hwy::GetChosenTarget().DeInit();
                EXPECT_NEAR(squared_norm(counted), expected, 1e-3 * expected)
                    << length << " values on " << hwy::TargetName(target);
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
        }
    }
}

}  // namespace
}  // namespace relume::engine
