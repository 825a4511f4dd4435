#include "protocol/basis/curve_basis.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace relume::basis {
namespace {

TEST(CurveBasis, LaysOutRestThenEachCurve) {
    for (const std::uint32_t curves : {1U, 2U, 16U}) {
        const CurveBasis basis(curves);
        EXPECT_EQ(basis.coefficient_count(), 1 + 257 * curves);
        for (std::uint32_t m = 0; m < curves; ++m) {
            EXPECT_EQ(basis.first_coefficient(m), 1 + 257 * m);
        }
    }
}

TEST(CurveBasis, BandsHoldTheLevelsOfAllCurves) {
    const CurveBasis basis(3);
    const Bands bands = basis.bands();
    ASSERT_EQ(bands.coefficient_count(), basis.coefficient_count());
    EXPECT_EQ(bands.octaves, (std::vector<float>{0, 0, 1, 2, 3, 4, 5, 6, 7}));
    std::map<std::uint32_t, std::size_t> counts;
    for (const std::uint8_t band : bands.of_coefficient) {
        ++counts[band];
    }
    EXPECT_EQ(counts[0], 1 + 2 * 3U);
    for (std::uint32_t level = 0; level < 8; ++level) {
        EXPECT_EQ(counts[1 + level], 3U << level);
    }
    EXPECT_EQ(bands.of_coefficient[CurveBasis::kRest], 0);
    for (std::uint32_t m = 0; m < 3; ++m) {
        const std::size_t wavelets = basis.first_coefficient(m) + 1;
        EXPECT_EQ(bands.of_coefficient[wavelets - 1], 0);  // the diffuse colour
        EXPECT_EQ(bands.of_coefficient[wavelets], 0);
        EXPECT_EQ(bands.of_coefficient[wavelets + 1], 1);
        EXPECT_EQ(bands.of_coefficient[wavelets + 127], 7);
        EXPECT_EQ(bands.of_coefficient[wavelets + 128], 8);
        EXPECT_EQ(bands.of_coefficient[wavelets + 255], 8);
    }
}

TEST(CurveBasis, RefusesOtherCounts) {
    EXPECT_THROW(CurveBasis(0), std::invalid_argument);
    EXPECT_THROW(CurveBasis(17), std::invalid_argument);
}

}  // namespace
}  // namespace relume::basis
