#include "server/engine/kernels/vector_loops.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace relume::engine {
namespace {

template <typename Float>
class AddRows : public testing::Test {};

using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(AddRows, Floats);

// The bits of the plain loop on every instruction set this processor has, for lengths that are
// no multiple of any vector, from any alignment, rows given twice and none at all.
TYPED_TEST(AddRows, GivesTheBitsOfThePlainLoopOnEveryTarget) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> value(-128, 127);
    std::vector<std::int8_t> table(5000);
    for (std::int8_t& entry : table) {
        entry = static_cast<std::int8_t>(value(random));
    }
    for (const std::size_t length : {1UL, 15UL, 16UL, 64UL, 67UL, 256UL, 32UL, 301UL}) {
        for (const std::size_t count : {0UL, 1UL, 2UL, 50UL}) {
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
                std::vector<TypeParam> sums(length, TypeParam{0.75});
                add_rows(table, rows, std::span(sums));
                EXPECT_EQ(sums, expected)
                    << count << " rows of " << length << " on " << hwy::TargetName(target);
            }
            hwy::SetSupportedTargetsForTest(0);
            hwy::GetChosenTarget().DeInit();
        }
    }
}

}  // namespace
}  // namespace relume::engine
