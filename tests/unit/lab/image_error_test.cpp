// Measures on images whose errors can be written down.
#include "tests/lab/measures/image_error.h"

#include "tests/lab/measures/perceptual_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

constexpr std::uint32_t kWidth = 16;
constexpr std::uint32_t kHeight = 8;
constexpr std::size_t kValues = std::size_t{3} * kWidth * kHeight;

TEST(ImageError, AConstantErrorIsTheSameInEveryNorm) {
    const std::vector<float> reference(kValues, 2);
    const std::vector<float> image(kValues, 2.5F);
    const ImageError error = image_error(image, reference, kWidth);
    EXPECT_DOUBLE_EQ(error.l2, 0.25);
    EXPECT_DOUBLE_EQ(error.h1, 0.25);  // neither has differences
    EXPECT_DOUBLE_EQ(error.peak, 0.25);
}

TEST(ImageError, OneWrongPixel) {
    // Of a constant reference, one value off by δ: ‖·‖₂ = δ, and δ² in each of its four
    // differences, two of which at the border do not exist.
    const std::vector<float> reference(kValues, 1);
    std::vector<float> inner = reference;
    inner[3 * (2 * kWidth + 5)] += 3;
    std::vector<float> corner = reference;
    corner[0] += 3;
    const double norm = std::sqrt(static_cast<double>(kValues));
    EXPECT_NEAR(image_error(inner, reference, kWidth).l2, 3 / norm, 1e-12);
    EXPECT_NEAR(image_error(inner, reference, kWidth).h1, 3 * std::sqrt(5) / norm, 1e-12);
    EXPECT_NEAR(image_error(corner, reference, kWidth).h1, 3 * std::sqrt(3) / norm, 1e-12);
    EXPECT_NEAR(image_error(inner, reference, kWidth).peak, 3, 1e-12);
}

TEST(ImageError, BlackIsNoDivisionByZero) {
    const std::vector<float> black(kValues, 0);
    const std::vector<float> grey(kValues, 1);
    EXPECT_EQ(image_error(black, black, kWidth).l2, 0);
    EXPECT_EQ(image_error(grey, black, kWidth).l2, 1);
    EXPECT_EQ(image_error(black, grey, kWidth).l2, 1);
}

TEST(ErrorChange, IsZeroForAnErrorThatStandsStill) {
    std::vector<float> previous(kValues, 0);
    const std::vector<float> first(kValues, 1);
    const std::vector<float> second(kValues, 3);
    std::vector<float> image(kValues, 1.5F);
    EXPECT_DOUBLE_EQ(error_change(image, first, previous), 0.5);  // from no error to 0.5
    image.assign(kValues, 3.5F);
    EXPECT_DOUBLE_EQ(error_change(image, second, previous), 0);
    EXPECT_DOUBLE_EQ(error_change(second, second, previous), 0.5 / 3);
}

TEST(MeanDeltaE, OfGreysIsTheirDifferenceInLightness) {
    // The display's linear tone, exposed so that the reference is at 0.18.
    const std::vector<float> reference(kValues, 5);
    EXPECT_EQ(mean_delta_e(reference, reference), 0);
    std::vector<float> image = reference;
    const double before = mean_delta_e(std::vector<float>(kValues, 6), reference);
    EXPECT_GT(before, 2.3);
    EXPECT_LT(before, 20);
    // Half of the pixels differ.
    for (std::size_t i = 0; i < kValues / 2; ++i) {
        image[i] = 6;
    }
    EXPECT_NEAR(mean_delta_e(image, reference), before / 2, 1e-9);
}

TEST(MeanDeltaE, DoesNotDependOnTheUnitOfRadiance) {
    std::vector<float> reference(kValues);
    std::vector<float> image(kValues);
    for (std::size_t i = 0; i < kValues; ++i) {
        reference[i] = 0.1F + static_cast<float>(i % 7);
        image[i] = 0.2F + static_cast<float>(i % 5);
    }
    const double once = mean_delta_e(image, reference);
    for (std::vector<float>* values : {&reference, &image}) {
        for (float& value : *values) {
            value *= 1024;
        }
    }
    EXPECT_NEAR(mean_delta_e(image, reference), once, 1e-5 * once);
}

TEST(MeanDeltaE, BlackAndWhiteAreAHundredApart) {
    // Far above the tone curve's shoulder every channel is white.
    std::vector<float> reference(kValues, 1);
    const std::vector<float> bright(kValues, 1e6F);
    const std::vector<float> black(kValues, 0);
    EXPECT_NEAR(mean_delta_e(bright, reference) + mean_delta_e(black, reference), 100, 1e-3);
}

}  // namespace
}  // namespace relume::lab
