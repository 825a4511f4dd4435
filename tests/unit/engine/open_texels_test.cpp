#include "server/engine/kernels/open_texels.h"

#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace relume::engine {
namespace {

TEST(OpenTexels, AreSummedWithTheBitsOfTheSpecificationOnEveryTarget) {
    for (const std::size_t words : {0UL, 1UL, 6UL, 384UL}) {
        const std::size_t texels = 64 * words;
        std::array<std::vector<float>, 3> values;
        for (unsigned colour = 0; colour < values.size(); ++colour) {
            values[colour] = tripling::random_values(texels + 1, colour);
        }
        const auto factor = tripling::random_values(texels + 1, 7);
        for (const double share : {0.0, 0.03, 0.5, 1.0}) {
            const auto open = tripling::bits_of(tripling::random_values(texels, 9, share));
            for (const std::size_t misalignment : {0U, 1U}) {
                const ColourPlanes planes{values[0].data() + misalignment,
                                          values[1].data() + misalignment,
                                          values[2].data() + misalignment};
                const float* factors = factor.data() + misalignment;
                const auto sum = sum_open_scalar(open, planes);
                const auto product_sum = sum_open_products_scalar(open, planes, factors);
                for (std::size_t colour = 0; colour < sum.size(); ++colour) {
                    double expected = 0;
                    double expected_product = 0;
                    for (std::size_t i = 0; i < texels; ++i) {
                        const double is_open = open[i / 64] >> i % 64 & 1U ? 1 : 0;
                        expected += is_open * planes[colour][i];
                        expected_product += is_open * planes[colour][i] * factors[i];
                    }
                    EXPECT_NEAR(sum[colour], expected, 1e-6 * static_cast<double>(texels));
                    EXPECT_NEAR(product_sum[colour], expected_product,
                                1e-6 * static_cast<double>(texels));
                }
                for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
                    hwy::SetSupportedTargetsForTest(target);
                    hwy::GetChosenTarget().DeInit();
                    EXPECT_EQ(sum_open(open, planes), sum) << hwy::TargetName(target);
                    EXPECT_EQ(sum_open_products(open, planes, factors), product_sum)
                        << hwy::TargetName(target);
                }
                hwy::SetSupportedTargetsForTest(0);
                hwy::GetChosenTarget().DeInit();
            }
        }
    }
}

}  // namespace
}  // namespace relume::engine
