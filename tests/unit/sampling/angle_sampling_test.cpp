// Directions spread evenly over the samples of a curve.
#include "protocol/sampling/angle_sampling.h"

#include "protocol/sampling/sobol.h"
#include "tests/support/sample_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace relume::sampling {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFarOff = 5;  // standard errors

TEST(AngleSampling, DensityIsThatOfItsSamples) {
    for (const SampledAngle angle : {SampledAngle::half, SampledAngle::reflection}) {
        for (const float cosine : {1.0F, 0.7F, 0.1F}) {
            const Imath::V3f wo(std::sqrt(1 - cosine * cosine), 0, cosine);
            // ∫ g cos dω over directions that are reached, both ways.
            const auto g = [](const Imath::V3f& wi) {
                return static_cast<double>(wi.z * (1 + 0.5F * wi.x));
            };
            test::SampleMoments<double> by_angle(0.0);
            double by_cosine = 0;
            constexpr std::uint32_t kCount = 1U << 16U;
            for (std::uint32_t i = 0; i < kCount; ++i) {
                const AngleSample sample = sample_angle(angle, wo, sobol_point(i, 5));
                if (sample.pdf > 0) {
                    ASSERT_NEAR(angle_pdf(angle, sample.wi, wo), sample.pdf,
                                1e-3F * sample.pdf);
                }
                by_angle.add(sample.pdf > 0 ? g(sample.wi) / static_cast<double>(sample.pdf)
                                            : 0.0);
                const Imath::V2f u = sobol_point(i, 6);
                const Imath::V3f wi(
                    std::sqrt(u.x) * std::cos(2 * static_cast<float>(kPi) * u.y),
                    std::sqrt(u.x) * std::sin(2 * static_cast<float>(kPi) * u.y),
                    std::sqrt(1 - u.x));
                if (angle_pdf(angle, wi, wo) > 0) {
                    by_cosine += kPi * g(wi) / static_cast<double>(wi.z) / kCount;
                }
            }
            EXPECT_NEAR(by_angle.mean(), by_cosine,
                        kFarOff * std::sqrt(by_angle.variance_of_mean()) + 1e-3)
                << cosine;
        }
    }
}

}  // namespace
}  // namespace relume::sampling
