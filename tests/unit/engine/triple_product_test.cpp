#include "server/engine/kernels/triple_product.h"

#include "protocol/tripling/sublinear_integral.h"
#include "server/engine/kernels/open_mixture.h"
#include "tests/unit/tripling/random_functions.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relume::engine {
namespace {

using tripling::SparseWavelets;
using tripling::SquareSet;
using tripling::TermOrder;

constexpr std::size_t kParts = 5;

// Light in three colours, points that see some of it, and tabulated materials.
struct Scene {
    std::uint32_t n = 0;
    std::array<std::vector<float>, 3> light;
    tripling::VisibilityWavelets visibility;
    std::vector<SparseWavelets> functions;
    tripling::WaveletStore store;
    std::array<float, kParts> weights{0.4F, 0.1F, 0.3F, -0.05F, 0.2F};

    Scene(std::uint32_t resolution, std::size_t terms)
        : n(resolution), visibility(resolution), store(resolution) {
        using tripling::coefficients_of;
        for (unsigned colour = 0; colour < light.size(); ++colour) {
            light[colour] = coefficients_of(n, tripling::random_cubemap(n, colour));
        }
        const std::size_t texels = basis::texel_count(n);
        for (const auto& open :
             {tripling::random_visibility(n, 11), std::vector<float>(texels, 1.0F),
              std::vector<float>(texels, 0.0F), tripling::random_visibility(n, 12)}) {
            visibility.append(tripling::bits_of(open));
        }
        for (unsigned part = 0; part < kParts; ++part) {
            const auto c = coefficients_of(n, tripling::random_cubemap(n, 20 + part));
            functions.emplace_back(
                tripling::largest_squares(n, c, terms, TermOrder::by_size).with_ancestors(), c);
            store.append(functions.back());
        }
    }

    [[nodiscard]] std::vector<WeightedWavelets> material() const {
        std::vector<WeightedWavelets> parts;
        for (std::size_t i = 0; i < functions.size(); ++i) {
            parts.push_back({.weight = weights[i], .function = store.view(i)});
        }
        return parts;
    }
    // The same sum as one function.
    [[nodiscard]] SparseWavelets mixed_material() const {
        std::vector<float> sum(basis::texel_count(n), 0);
        std::vector<std::uint32_t> squares;
        for (std::size_t i = 0; i < functions.size(); ++i) {
            const auto c = functions[i].coefficients();
            for (std::size_t j = 0; j < sum.size(); ++j) {
                sum[j] += weights[i] * c[j];
            }
            functions[i].squares().for_each([&](std::size_t square) {
                squares.push_back(static_cast<std::uint32_t>(square));
            });
        }
        return {SquareSet(n, squares), sum};
    }
    [[nodiscard]] LightTable light_table() const {
        LightTable table(n);
        table.set({light[0], light[1], light[2]});
        return table;
    }
};

constexpr std::array<std::uint32_t, 4> kResolutions{4, 8, 32, 64};
constexpr std::array<std::uint32_t, 7> kAllResolutions{4, 8, 16, 32, 64, 128, 256};

TEST(TripleProduct, IsTheSumOfTheTermsThatItIsGiven) {
    for (const std::uint32_t n : kResolutions) {
        const Scene scene(n, std::size_t{2} * n);
        const LightTable light = scene.light_table();
        const SquareSet light_terms = tripling::largest_squares(
            n, scene.light[1], std::size_t{3} * n, TermOrder::by_area);
        const SparseWavelets material = scene.mixed_material();
        TripleWorkspace workspace(n);
        for (std::size_t point = 0; point < scene.visibility.point_count(); ++point) {
            multiply_visibility(scene.visibility.point(point), scene.material(),
                                light_terms.words(), workspace);
            const Radiance radiance = sum_light(light, workspace);
            const SparseWavelets visibility = scene.visibility.sparse(point);
            for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
                const SparseWavelets all_light(
                    tripling::nonzero_squares(n, scene.light[colour]), scene.light[colour]);
                EXPECT_NEAR(radiance[colour],
                            tripling::sublinear_triple_integral(all_light, light_terms,
                                                                visibility, material),
                            1e-5 * n * n)
                    << "point " << point << " of n = " << n;
            }
        }
    }
}

// With all terms it is the sum over texels.
TEST(TripleProduct, OfAllTermsIsThePixelProduct) {
    for (const std::uint32_t n : kAllResolutions) {
        const Scene scene(n, std::size_t{18} * n * n);
        const LightTable light = scene.light_table();
        const SquareSet all = tripling::nonzero_squares(n, scene.light[0]);
        auto material = scene.mixed_material().coefficients();
        basis::haar_inverse_cubemap(n, material);
        TripleWorkspace workspace(n);
        for (std::size_t point = 0; point < scene.visibility.point_count(); ++point) {
            multiply_visibility(scene.visibility.point(point), scene.material(), all.words(),
                                workspace);
            const Radiance radiance = sum_light(light, workspace);
            auto open = scene.visibility.sparse(point).coefficients();
            basis::haar_inverse_cubemap(n, open);
            for (std::size_t colour = 0; colour < radiance.size(); ++colour) {
                auto texels = scene.light[colour];
                basis::haar_inverse_cubemap(n, texels);
                double sum = 0;
                double size = 0;
                for (std::size_t i = 0; i < texels.size(); ++i) {
                    const double term = 1.0 * texels[i] * open[i] * material[i];
                    sum += term;
                    size += std::abs(term);
                }
                EXPECT_NEAR(radiance[colour], sum, 1e-5 * size);
            }
        }
    }
}

// A sun of 10⁶ times the light stands where the point sees nothing. Over texels it does not
// count at all; over wavelets large terms of opposite signs leave their rounding.
TEST(TripleProduct, OfASunThatIsHiddenCancels) {
    constexpr std::uint32_t n = 64;
    constexpr float kSun = 1e6F;
    const std::size_t texels = basis::texel_count(n);
    std::vector<float> open(texels, 1.0F);
    std::vector<float> light(texels, 1.0F);
    std::vector<float> with_sun = light;
    for (std::size_t i = 0; i < texels; ++i) {
        const auto texel = basis::texel_from_index(n, i);
        if (texel.face == basis::Face::positive_y && texel.row / 8 == 3 &&
            texel.column / 8 == 4) {
            open[i] = 0;
            with_sun[i] = texel.row % 8 < 2 && texel.column % 8 < 3 ? kSun : 1;
        }
    }
    const auto material = tripling::random_cubemap(n, 5);
    const auto bits = tripling::bits_of(open);
    tripling::TexelStore by_texels(n);
    by_texels.append(material, 0);
    const std::array mixture{WeightedTexels{.weight = 1, .function = by_texels.view(0)}};
    const auto over_texels = [&](const std::vector<float>& of) {
        return sum_open_mixture(bits, {of.data(), of.data(), of.data()}, mixture);
    };
    EXPECT_EQ(over_texels(with_sun), over_texels(light));

    tripling::VisibilityWavelets visibility(n);
    visibility.append(bits);
    const auto c = tripling::coefficients_of(n, material);
    tripling::WaveletStore store(n);
    store.append(SparseWavelets(tripling::nonzero_squares(n, c).with_ancestors(), c));
    const std::array<WeightedWavelets, 1> one{{{.weight = 1, .function = store.view(0)}}};
    const auto over_wavelets = [&](const std::vector<float>& of) {
        const auto coefficients = tripling::coefficients_of(n, of);
        LightTable table(n);
        table.set({coefficients, coefficients, coefficients});
        TripleWorkspace workspace(n);
        multiply_visibility(visibility.point(0), one,
                            tripling::nonzero_squares(n, coefficients).words(), workspace);
        return sum_light(table, workspace)[0];
    };
    double of_sun = 0;  // were it seen
    for (std::size_t i = 0; i < texels; ++i) {
        of_sun += with_sun[i] > 1 ? std::abs(double{kSun} * material[i]) : 0;
    }
    EXPECT_NEAR(over_wavelets(with_sun), over_wavelets(light), 1e-5 * of_sun);
}

// One workspace for receiver after receiver: none leaves anything behind.
TEST(TripleProduct, DoesNotDependOnWhatTheWorkspaceDidBefore) {
    constexpr std::uint32_t n = 32;
    const Scene scene(n, 100);
    const LightTable light = scene.light_table();
    const SquareSet terms = tripling::nonzero_squares(n, scene.light[0]);
    TripleWorkspace used(n);
    for (const std::size_t point : {3U, 2U, 1U, 0U, 3U}) {
        multiply_visibility(scene.visibility.point(point), scene.material(), terms.words(),
                            used);
        TripleWorkspace fresh(n);
        multiply_visibility(scene.visibility.point(point), scene.material(), terms.words(),
                            fresh);
        EXPECT_EQ(sum_light(light, used), sum_light(light, fresh));
    }
    multiply_visibility(scene.visibility.point(0), {}, terms.words(), used);
    EXPECT_EQ(used.squares().size(), 0U) << "no material, and still products";
}

TEST(TripleProduct, GivesTheBitsOfTheSpecificationOnEveryTarget) {
    for (const std::uint32_t n : kResolutions) {
        for (const std::size_t terms : {std::size_t{0}, std::size_t{3} * n}) {
            const Scene scene(n, terms);
            const LightTable light = scene.light_table();
            const SquareSet light_terms =
                tripling::largest_squares(n, scene.light[2], terms, TermOrder::by_size);
            for (std::size_t point = 0; point < scene.visibility.point_count(); ++point) {
                TripleWorkspace expected(n);
                multiply_visibility_scalar(scene.visibility.point(point), scene.material(),
                                           light_terms.words(), expected);
                const Radiance expected_radiance = sum_light_scalar(light, expected);
                for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
                    hwy::SetSupportedTargetsForTest(target);
                    hwy::GetChosenTarget().DeInit();
                    TripleWorkspace workspace(n);
                    multiply_visibility(scene.visibility.point(point), scene.material(),
                                        light_terms.words(), workspace);
                    EXPECT_TRUE(
                        std::equal(workspace.squares().begin(), workspace.squares().end(),
                                   expected.squares().begin(), expected.squares().end()));
                    EXPECT_TRUE(
                        std::equal(workspace.products().begin(), workspace.products().end(),
                                   expected.products().begin(), expected.products().end()))
                        << hwy::TargetName(target);
                    EXPECT_EQ(sum_light(light, workspace), expected_radiance)
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
