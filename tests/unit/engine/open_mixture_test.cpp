#include "server/engine/kernels/open_mixture.h"

#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <vector>

namespace relume::engine {
namespace {

// Functions that are not zero in a few runs each, and light up to a multiple of 64 texels.
struct Scene {
    std::uint32_t n = 0;
    std::array<std::vector<float>, 3> light;
    std::vector<std::vector<std::uint64_t>> open;
    std::vector<std::vector<float>> texels;
    tripling::TexelStore store;

    Scene(std::uint32_t resolution, unsigned functions) : n(resolution), store(resolution) {
        for (unsigned colour = 0; colour < light.size(); ++colour) {
            light[colour] = tripling::random_cubemap(n, colour);
            light[colour].resize(tripling::run_count(n) * tripling::kRunTexels, 0.0F);
        }
        for (unsigned seed = 1; seed < 4; ++seed) {
            open.push_back(tripling::bits_of(tripling::random_visibility(n, seed)));
        }
        open.emplace_back(open.front().size(), 0);
        for (unsigned f = 0; f < functions; ++f) {
            auto& values = texels.emplace_back(tripling::random_cubemap(n, 30 + f));
            for (std::size_t i = 0; i < values.size(); ++i) {
                values[i] = (i / 64 + f) % 3 == 0 ? values[i] : 0.0F;
            }
            store.append(values, 0);
        }
    }
    [[nodiscard]] ColourPlanes planes() const {
        return {light[0].data(), light[1].data(), light[2].data()};
    }
    [[nodiscard]] std::vector<WeightedTexels> functions() const {
        std::vector<WeightedTexels> parts;
        for (std::size_t f = 0; f < store.size(); ++f) {
            parts.push_back(
                {.weight = 0.3F - 0.05F * static_cast<float>(f), .function = store.view(f)});
        }
        return parts;
    }
};

constexpr std::array<std::uint32_t, 5> kResolutions{4, 8, 32, 64, 128};

TEST(OpenMixture, IsThePixelProduct) {
    for (const std::uint32_t n : kResolutions) {
        const Scene scene(n, 5);
        const auto parts = scene.functions();
        for (const auto& open : scene.open) {
            const auto radiance = sum_open_mixture(open, scene.planes(), parts);
            for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
                double sum = 0;
                double size = 0;
                for (std::size_t t = 0; t < basis::texel_count(n); ++t) {
                    double mixed = 0;
                    for (std::size_t f = 0; f < parts.size(); ++f) {
                        mixed += double{parts[f].weight} * double{scene.texels[f][t]};
                    }
                    const double term = (open[t / 64] >> t % 64 & 1U) != 0
                                            ? double{scene.light[colour][t]} * mixed
                                            : 0;
                    sum += term;
                    size += std::abs(term);
                }
                EXPECT_NEAR(radiance[colour], sum, 1e-5 * size) << "n = " << n;
            }
        }
    }
}

TEST(OpenMixture, OfOneFunctionIsTheProductWithIt) {
    const Scene scene(32, 1);
    std::vector<float> factor = scene.texels[0];
    for (const auto& open : scene.open) {
        const std::array one{WeightedTexels{.weight = 1, .function = scene.store.view(0)}};
        EXPECT_EQ(sum_open_mixture(open, scene.planes(), one),
                  sum_open_products(open, scene.planes(), factor.data()));
    }
}

TEST(OpenMixture, OfNoFunctionIsNothing) {
    const Scene scene(16, 0);
    EXPECT_EQ(sum_open_mixture(scene.open[0], scene.planes(), {}), (std::array<float, 3>{}));
}

TEST(OpenMixture, GivesTheBitsOfTheSpecificationOnEveryTarget) {
    for (const std::uint32_t n : kResolutions) {
        for (const unsigned functions : {1U, 4U, 16U}) {
            const Scene scene(n, functions);
            const auto parts = scene.functions();
            for (const auto& open : scene.open) {
                const auto expected = sum_open_mixture_scalar(open, scene.planes(), parts);
                for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
                    hwy::SetSupportedTargetsForTest(target);
                    hwy::GetChosenTarget().DeInit();
                    EXPECT_EQ(sum_open_mixture(open, scene.planes(), parts), expected)
                        << hwy::TargetName(target) << ", n = " << n;
                }
                hwy::SetSupportedTargetsForTest(0);
                hwy::GetChosenTarget().DeInit();
            }
        }
    }
}

}  // namespace
}  // namespace relume::engine
