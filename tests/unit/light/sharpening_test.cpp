// What is given back of a blur.
#include "protocol/light/sharpening.h"

#include "protocol/basis/cubemap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <vector>

namespace relume::light {
namespace {

constexpr std::uint32_t kSide = 32;
constexpr std::uint32_t kStride = 4;
constexpr float kStrength = 0.16F;

class Faces {
  public:
    explicit Faces(const std::function<float(const basis::Texel&)>& radiance)
        : values_(PaddedCubemap::value_count(kSide, 3)) {
        for_each([&](const basis::Texel& texel, float* rgb) {
            std::fill_n(rgb, 3, radiance(texel));
        });
    }
    void sharpen() { light::sharpen(padded(), kSide, kStride, kStrength); }

    template <typename Visit>
    void for_each(Visit visit) {
        for (std::size_t i = 0; i < basis::texel_count(kSide); ++i) {
            const basis::Texel texel = basis::texel_from_index(kSide, i);
            visit(texel, padded().at(texel.face, static_cast<int>(texel.row),
                                     static_cast<int>(texel.column)));
        }
    }
    double energy() {
        double sum = 0;
        for_each([&](const basis::Texel& texel, const float* rgb) {
            sum += rgb[1] * basis::solid_angle_sr(kSide, texel.row, texel.column);
        });
        return sum;
    }
    float at(const basis::Texel& texel) {
        return padded().at(texel.face, static_cast<int>(texel.row),
                           static_cast<int>(texel.column))[1];
    }

  private:
    PaddedCubemap padded() { return {values_, kSide, 3}; }

    std::vector<float> values_;
};

TEST(Sharpening, LeavesAConstantAsItIs) {
    Faces faces([](const basis::Texel&) { return 3.0F; });
    faces.sharpen();
    faces.for_each([](const basis::Texel&, const float* rgb) { EXPECT_EQ(rgb[0], 3.0F); });
}

TEST(Sharpening, KeepsTheEnergyAndNeverGoesBelowZero) {
    // Texels of any brightness, on edges and corners as well.
    std::mt19937 random(1);
    std::exponential_distribution<float> exponential;
    Faces faces([&](const basis::Texel&) {
        const float value = exponential(random);
        return value > 2 ? 1e4F * value : (value < 0.5F ? 0.0F : value);
    });
    const double before = faces.energy();
    faces.sharpen();
    EXPECT_NEAR(faces.energy() / before, 1, 1e-6);
    faces.for_each([](const basis::Texel&, const float* rgb) { EXPECT_GE(rgb[2], 0.0F); });
}

TEST(Sharpening, TakesABlurBack) {
    // Half of the difference of a wave of two strides, in a face's middle, where texels are
    // alike: 1 + 4·strength times as high.
    const auto wave = [](const basis::Texel& texel) {
        return 2.0F + (texel.column / kStride % 2 == 0 ? 0.5F : -0.5F);
    };
    Faces faces(wave);
    faces.sharpen();
    for (std::uint32_t column = kSide / 2 - 4; column < kSide / 2 + 4; ++column) {
        const basis::Texel texel{basis::Face::negative_z, kSide / 2, column};
        const float sign = wave(texel) > 2 ? 1.0F : -1.0F;
        EXPECT_NEAR(faces.at(texel), 2 + sign * 0.5F * (1 + 4 * kStrength), 0.02F);
    }
}

TEST(Sharpening, LeavesWhatRepeatsWithItsStride) {
    Faces faces(
        [](const basis::Texel& texel) { return texel.column % kStride == 0 ? 2.0F : 1.0F; });
    faces.sharpen();
    for (std::uint32_t column = 8; column < kSide - 8; ++column) {
        const basis::Texel texel{basis::Face::positive_x, kSide / 2, column};
        EXPECT_EQ(faces.at(texel), column % kStride == 0 ? 2.0F : 1.0F);
    }
}

}  // namespace
}  // namespace relume::light
