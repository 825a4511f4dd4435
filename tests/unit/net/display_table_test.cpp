#include "server/net/display_table.h"

#include "protocol/wire/display.h"

#include <gtest/gtest.h>

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

INSTANTIATE_TEST_SUITE_P(All,
                         DisplayTableLaws,
                         testing::Values(wire::Display{0, Tone::filmic},
                                         wire::Display{0, Tone::linear},
                                         wire::Display{-20, Tone::filmic},
                                         wire::Display{20, Tone::linear},
                                         wire::Display{3.7, Tone::filmic}));

}  // namespace
}  // namespace relume::net
