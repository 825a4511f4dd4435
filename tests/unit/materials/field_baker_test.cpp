#include "precompute/materials/field_baker.h"

#include "precompute/scene/bsdf.h"
#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace relume::materials {
namespace {

Imath::V3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Imath::V3f(normal(random), normal(random), normal(random)).normalized();
}

std::vector<float> mixed_texels(const tripling::MaterialField& field,
                                std::size_t lobe,
                                const tripling::FieldPlace& place) {
    const std::uint32_t n = field.face_resolution();
    std::vector<float> sum(basis::texel_count(n), 0);
    for (std::size_t i = 0; i < place.count; ++i) {
        const tripling::WaveletView view = field.lobes[lobe].view(place.entries[i].index);
        for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
            const float weight = place.entries[i].weight;
            sum[face * n * n] += weight * view.scaling[face];
            for (std::uint32_t s = view.first[face]; s < view.first[face + 1]; ++s) {
                const auto square = tripling::square_from_index(view.squares[s]);
                for (std::size_t m = 0; m < 3; ++m) {
                    sum[face * n * n + tripling::coefficient_from_wavelet(
                                           n, square, tripling::kWaveletTypes[m])] +=
                        weight * view.values[s][m + 1];
                }
            }
        }
    }
    basis::haar_inverse_cubemap(n, sum);
    return sum;
}

double total(const std::vector<float>& texels) {
    return std::accumulate(texels.begin(), texels.end(), 0.0);
}

TEST(FieldBaker, IntegralsOverTheSphereAreThoseOfTheModel) {
    const TexelSamples samples(16, 3);
    std::mt19937 random(3);
    for (int i = 0; i < 5; ++i) {
        const Imath::V3f normal = random_direction(random);
        const Imath::V3f reflection = random_direction(random);
        EXPECT_NEAR(total(lobe_texels(lambert_model(), samples, normal, reflection)[0]), 1,
                    1e-3);
        for (const float exponent : {1.0F, 8.0F, 64.0F}) {
            EXPECT_NEAR(
                total(lobe_texels(phong_model(exponent), samples, normal, reflection)[0]), 1,
                4e-3)
                << "exponent " << exponent;
        }
    }
}

// The GGX lobes, weighted by the colours of a surface, against its BSDF at each texel.
TEST(FieldBaker, LobesAreThoseOfTheBsdf) {
    const auto bsdf = scene::Bsdf::ggx({0.8F, 0.5F, 0.2F}, 0.3F, 0.5F);
    const FieldModel model = lobes_model("ggx", factors::lobes_of(bsdf));
    const auto colours = factors::lobe_colours(bsdf);
    ASSERT_EQ(colours.size(), model.lobe_count);
    const TexelSamples samples(8, 1);
    std::mt19937 random(4);
    for (int i = 0; i < 5; ++i) {
        // The pole, so that the local frame is known.
        const Imath::V3f normal(0, 0, 1);
        Imath::V3f viewer = random_direction(random);
        viewer.z = std::abs(viewer.z);
        viewer.normalize();
        const auto lobes =
            lobe_texels(model, samples, normal, tripling::mirrored(viewer, normal));
        for (std::size_t texel = 0; texel < lobes[0].size(); ++texel) {
            const auto light =
                basis::direction_from_texel(8, basis::texel_from_index(8, texel));
            const Imath::V3f f = light.z > 0 ? bsdf.evaluate(light, viewer) : Imath::V3f(0);
            for (int colour = 0; colour < 3; ++colour) {
                float sum = 0;
                for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
                    sum += colours[lobe][colour] * lobes[lobe][texel];
                }
                const float expected = f[colour] * light.z * samples.solid_angles_sr()[texel];
                EXPECT_NEAR(sum, expected, 1e-4F * (1 + expected));
            }
        }
    }
}

// With all of the energy, an entry is the model; between entries, the weights' mean of them.
TEST(FieldBaker, EntriesAreTheModelAtTheNodes) {
    FieldParameters parameters{.face_resolution = 16,
                               .normal_side = 3,
                               .reflection_side = 3,
                               .energy_fraction = 1,
                               .samples_per_side = 2};
    FieldReport report;
    const FieldModel model =
        lobes_model("ggx", factors::lobes_of(scene::Bsdf::ggx(Imath::V3f(1), 1, 0.6F)));
    const tripling::MaterialField field = bake_field(model, parameters, report);
    EXPECT_EQ(field.entry_count(), 54U * 54U);
    EXPECT_EQ(report.entries, field.entry_count() * model.lobe_count);
    const TexelSamples samples(16, 2);
    for (const std::size_t entry : {0UL, 717UL, 2915UL}) {
        const Imath::V3f normal = field.normals.direction(entry / 54);
        const Imath::V3f reflection = field.reflections.direction(entry % 54);
        const auto expected = lobe_texels(model, samples, normal, reflection);
        tripling::FieldPlace place;
        place.entries[0] = {.index = entry, .weight = 1};
        place.count = 1;
        for (std::size_t lobe = 0; lobe < model.lobe_count; ++lobe) {
            const auto texels = mixed_texels(field, lobe, place);
            for (std::size_t i = 0; i < texels.size(); ++i) {
                ASSERT_NEAR(texels[i], expected[lobe][i], 1e-5);
            }
        }
    }
}

TEST(FieldBaker, KeepsTheEnergyThatIsAskedFor) {
    std::size_t before = 0;
    for (const double fraction : {0.5, 0.9, 0.99, 0.999}) {
        FieldReport report;
        const auto field = bake_field(
            phong_model(30),
            {.face_resolution = 32, .reflection_side = 2, .energy_fraction = fraction}, report);
        EXPECT_EQ(field.normals.node_count(), 1U);
        EXPECT_EQ(field.entry_count(), 24U);
        EXPECT_GE(report.least_energy, fraction - 1e-6);
        EXPECT_GT(report.nonzero, before);
        before = report.nonzero;
    }
}

TEST(FieldBaker, InterpolationApproachesTheModelAsGridsGrow) {
    std::mt19937 random(5);
    const TexelSamples samples(16, 2);
    double before = 1e30;
    for (const std::uint32_t side : {3U, 5U, 9U, 17U}) {
        FieldReport report;
        const FieldModel model = phong_model(8);
        const auto field = bake_field(
            model, {.face_resolution = 16, .reflection_side = side, .energy_fraction = 1},
            report);
        double error = 0;
        double norm = 0;
        std::mt19937 same(6);
        for (int i = 0; i < 30; ++i) {
            const Imath::V3f reflection = random_direction(same);
            const auto texels =
                mixed_texels(field, 0, tripling::place_in_field(field, {0, 1, 0}, reflection));
            const auto expected = lobe_texels(model, samples, {0, 1, 0}, reflection)[0];
            for (std::size_t t = 0; t < texels.size(); ++t) {
                error += std::pow(texels[t] - expected[t], 2.0);
                norm += std::pow(expected[t], 2.0);
            }
        }
        const double relative = std::sqrt(error / norm);
        EXPECT_LT(relative, 0.5 * before) << "side " << side;
        before = relative;
    }
}

// A direction that goes round the cube changes what a field gives by little, wherever it
// crosses from face to face.
TEST(FieldBaker, FieldsAreContinuousAcrossEdgesOfFaces) {
    FieldReport report;
    const tripling::MaterialField phong =
        bake_field(phong_model(20),
                   {.face_resolution = 16, .reflection_side = 9, .energy_fraction = 1}, report);
    const tripling::MaterialField lambert =
        bake_field(lambert_model(),
                   {.face_resolution = 16, .normal_side = 5, .energy_fraction = 1}, report);
    // Brighter on one side, so that what is at stake is more than the sum of all texels.
    std::vector<float> light;
    for (std::size_t i = 0; i < basis::texel_count(16); ++i) {
        const auto direction = basis::direction_from_texel(16, basis::texel_from_index(16, i));
        light.push_back(std::exp(2 * direction.dot(Imath::V3f(0.6F, 0.64F, 0.48F))));
    }
    for (const auto& [field, name] :
         {std::pair(&phong, "phong"), std::pair(&lambert, "lambert")}) {
        constexpr int kSteps = 720;
        constexpr double kMostChange = 0.03;
        double before = 0;
        for (int i = 0; i <= kSteps; ++i) {
            const double angle = 2 * std::numbers::pi * i / kSteps;
            // Through six faces, and close to a corner.
            const Imath::V3f direction = Imath::V3f(static_cast<float>(std::cos(angle)),
                                                    static_cast<float>(std::sin(angle)),
                                                    static_cast<float>(std::sin(angle + 0.8)))
                                             .normalized();
            const auto texels =
                mixed_texels(*field, 0, tripling::place_in_field(*field, direction, direction));
            const double sum =
                std::inner_product(texels.begin(), texels.end(), light.begin(), 0.0);
            if (i > 0) {
                EXPECT_NEAR(sum, before, kMostChange * before) << name << " at step " << i;
            }
            before = sum;
        }
    }
}

// Entries beside a grazing one have viewers below the horizon: no energy is made there, and
// nothing is undefined.
TEST(FieldBaker, ViewersBelowTheHorizonMakeNoEnergy) {
    const TexelSamples samples(16, 2);
    std::mt19937 random(7);
    for (const float roughness : {0.1F, 0.4F, 1.0F}) {
        const auto bsdf = scene::Bsdf::ggx(Imath::V3f(1), 0, roughness);
        const FieldModel model = lobes_model("ggx", factors::lobes_of(bsdf));
        for (int i = 0; i < 40; ++i) {
            const Imath::V3f normal = random_direction(random);
            Imath::V3f viewer = random_direction(random);
            if (viewer.dot(normal) > 0.05F) {
                viewer = -viewer;  // below, or just above
            }
            const auto lobes =
                lobe_texels(model, samples, normal, tripling::mirrored(viewer, normal));
            double white = 0;
            for (std::size_t lobe = 0; lobe < lobes.size(); ++lobe) {
                for (const float value : lobes[lobe]) {
                    ASSERT_TRUE(std::isfinite(value)) << roughness;
                    white += double{model.colours[lobe].x} * value;
                }
            }
            EXPECT_GE(white, 0) << roughness;
            // A highlight at grazing angles is sharper than the texels' four samples.
            EXPECT_LE(white, 1.6) << roughness;
        }
    }
}

TEST(FieldBaker, RefusesParametersOutOfRange) {
    FieldReport report;
    const auto bake = [&](const FieldParameters& parameters) {
        return bake_field(lambert_model(), parameters, report);
    };
    EXPECT_THROW(bake({.face_resolution = 48}), std::invalid_argument);
    EXPECT_THROW(bake({.face_resolution = 8, .normal_side = 0}), std::invalid_argument);
    EXPECT_THROW(bake({.face_resolution = 8, .normal_side = 400}), std::invalid_argument);
    EXPECT_THROW(bake({.face_resolution = 8, .energy_fraction = 0}), std::invalid_argument);
    EXPECT_THROW(bake({.face_resolution = 8, .energy_fraction = 1.5}), std::invalid_argument);
    EXPECT_THROW(bake({.face_resolution = 8, .samples_per_side = 9}), std::invalid_argument);
}

}  // namespace
}  // namespace relume::materials
