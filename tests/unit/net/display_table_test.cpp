#include "server/net/images/display_table.h"

#include "protocol/wire/display.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

namespace relume::net {
namespace {

using wire::Tone;

class DisplayTableLaws : public testing::TestWithParam<wire::Display> {};

// Over 20 powers of two around the values that this exposure shows, evenly in the logarithm.
std::vector<float> shown_values(const wire::Display& display) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> exponent(-16, 4);
    std::vector<float> values;
    for (int i = 0; i < 50'000; ++i) {
        values.push_back(
            static_cast<float>(std::exp2(exponent(generator) - display.exposure_stops)));
    }
    return values;
}

TEST_P(DisplayTableLaws, GivesTheCodeOfTheFormula) {
    const wire::Display display = GetParam();
    const DisplayTable table(display);
    int differing = 0;
    for (const float value : shown_values(display)) {
        const int expected = wire::code_from_linear(value, display);
        const int found = table.code(value);
        ASSERT_LE(std::abs(found - expected), 1) << value;
        differing += found == expected ? 0 : 1;
    }
    // The formula in floats is not quite monotonic: within an ulp of a threshold both are
    // right.
    EXPECT_LE(differing, 2);
}

TEST_P(DisplayTableLaws, HandlesWhatLiesOutside) {
    const wire::Display display = GetParam();
    const DisplayTable table(display);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(table.code(0), 0);
    EXPECT_EQ(table.code(-1), 0);
    EXPECT_EQ(table.code(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(table.code(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(table.code(std::numeric_limits<float>::max()), 255);
    EXPECT_EQ(table.code(kInfinity), 255);
}

// Of many values at once the codes of each, on every instruction set, whatever their number.
TEST_P(DisplayTableLaws, GivesManyTheCodesOfEach) {
    const DisplayTable table(GetParam());
    std::vector<float> values = shown_values(GetParam());
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float outside :
         {0.0F, -0.0F, -1.0F, -kInfinity, kInfinity, std::numeric_limits<float>::quiet_NaN(),
          -std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::denorm_min(),
          std::numeric_limits<float>::max()}) {
        values.insert(values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), outside);
    }
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{15},
                                        std::size_t{33}, values.size()}) {
            const std::span<const float> some(values.data() + (values.size() - count) / 2,
                                              count);
            std::vector<std::uint8_t> codes(count);
            table.codes(some, codes);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(codes[i], table.code(some[i])) << some[i];
            }
        }
        hwy::SetSupportedTargetsForTest(0);
    }
}

INSTANTIATE_TEST_SUITE_P(All,
                         DisplayTableLaws,
                         testing::Values(wire::Display{0, Tone::filmic},
                                         wire::Display{0, Tone::linear},
                                         wire::Display{-20, Tone::filmic},
                                         wire::Display{20, Tone::linear},
                                         wire::Display{3.7, Tone::filmic}));

}  // namespace
}  // namespace relume::net
