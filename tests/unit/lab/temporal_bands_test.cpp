// Energy of a light over images, and what updates cover of the sphere.
#include "tests/lab/measures/temporal_bands.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "tests/lab/measures/coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace relume::lab {
namespace {

constexpr std::array<std::uint8_t, 4> kBands{0, 0, 1, 1};

std::vector<float> lighting_of(float coarse, float fine) {
    std::vector<float> lighting(3 * kBands.size());
    for (std::size_t i = 0; i < lighting.size(); ++i) {
        lighting[i] = kBands[i % kBands.size()] == 0 ? coarse : fine;
    }
    return lighting;
}

TEST(TemporalBands, AStillLightIsAllMean) {
    TemporalBands bands(kBands);
    for (int image = 0; image < 8; ++image) {
        bands.add(lighting_of(2, 1));
    }
    const TemporalSpectrum spectrum = bands.spectrum();
    EXPECT_EQ(spectrum.images, 8U);
    // Six coefficients, eight images.
    EXPECT_NEAR(spectrum.energy[0][0], 6 * 8 * 4, 1e-9);
    EXPECT_NEAR(spectrum.energy[1][0], 6 * 8, 1e-9);
    for (std::size_t t = 1; t < 4; ++t) {
        EXPECT_NEAR(spectrum.energy[0][t], 0, 1e-9);
    }
}

TEST(TemporalBands, AFlickerIsInTheShortestAndAStepInTheLongest) {
    TemporalBands bands(kBands);
    for (int image = 0; image < 8; ++image) {
        bands.add(lighting_of(image < 4 ? 1.0F : -1.0F, image % 2 == 0 ? 1.0F : -1.0F));
    }
    const TemporalSpectrum spectrum = bands.spectrum();
    EXPECT_NEAR(spectrum.energy[0][1], 6 * 8, 1e-9);
    EXPECT_NEAR(spectrum.energy[1][3], 6 * 8, 1e-9);
    EXPECT_NEAR(spectrum.energy[0][3] + spectrum.energy[1][1], 0, 1e-9);
}

TEST(TemporalBands, EnergyIsThatOfTheImagesItTakes) {
    TemporalBands bands(kBands);
    double energy = 0;
    for (int image = 0; image < 11; ++image) {
        const std::vector<float> lighting =
            lighting_of(static_cast<float>(image * image % 7), static_cast<float>(image % 3));
        bands.add(lighting);
        if (image < 8) {
            energy +=
                std::inner_product(lighting.begin(), lighting.end(), lighting.begin(), 0.0);
        }
    }
    double found = 0;
    for (const std::vector<double>& band : bands.spectrum().energy) {
        found = std::accumulate(band.begin(), band.end(), found);
    }
    EXPECT_NEAR(found, energy, 1e-9 * energy);
}

TEST(Coverage, EveryWaveletCoversItsSupport) {
    constexpr std::uint32_t kFace = 8;
    const std::size_t count = basis::texel_count(kFace);
    for (std::size_t j = 0; j < count; ++j) {
        std::vector<bool> updated(count);
        updated[j] = true;
        const std::vector<std::uint8_t> levels = covered_levels(kFace, updated);
        std::vector<float> wavelet(count);
        wavelet[j] = 1;
        basis::haar_inverse_cubemap(kFace, wavelet);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(levels[i], wavelet[i] != 0 ? 1 : 0) << j << ", texel " << i;
        }
    }
}

TEST(Coverage, AllUpdatedCoversEveryTexelByAllLevels) {
    constexpr std::uint32_t kFace = 16;
    const std::vector<std::uint8_t> levels =
        covered_levels(kFace, std::vector<bool>(basis::texel_count(kFace), true));
    EXPECT_TRUE(std::all_of(levels.begin(), levels.end(), [](std::uint8_t level) {
        return level == basis::band_count(kFace);
    }));
}

}  // namespace
}  // namespace relume::lab
