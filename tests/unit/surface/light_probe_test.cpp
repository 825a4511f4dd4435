// The probe of the real light, and what refinement makes of it.
#include "precompute/bake/probes/light_probe.h"

#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "tests/unit/surface/small_scenes.h"
#include "tests/unit/surface/surface_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace relume::bake {
namespace {

// Every material is white.
const std::vector<const brdf::FactoredBrdf*>& white() {
    static const brdf::FactoredBrdf lambert = brdf::factored_lambert("white", {1, 1, 1});
    static const std::vector<const brdf::FactoredBrdf*> brdfs(4, &lambert);
    return brdfs;
}

ProbePoint floor_point(float x, float z) {
    ProbePoint point{.position = {x, 0, z}, .normal = {0, 1, 0}};
    point.origins.fill({x, 1e-5F, z});
    return point;
}

std::vector<float> row_of(const LightProbe& probe, const ProbePoint& point) {
    std::vector<float> row(probe.row_size());
    (void)probe.write_row(point, row);
    return row;
}

double squared_length(const std::vector<float>& row) {
    return std::inner_product(row.begin(), row.end(), row.begin(), 0.0);
}

scene::Scene floor_and_box(float side, const Imath::V3f& centre, const Imath::V3f& size) {
    return scene_of({square_mesh(side), box_mesh(centre, size)});
}

TEST(LightProbe, AnUnoccludedSurfaceShowsTheConstantLight) {
    const scene::Scene scene = scene_of({square_mesh(4)});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {});
    EXPECT_NEAR(row_of(probe, floor_point(0, 0))[0], 1, 1e-3);
}

TEST(LightProbe, WhatSeesTheSameHasTheSameRow) {
    const scene::Scene scene = scene_of({square_mesh(4)});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {});
    EXPECT_EQ(row_of(probe, floor_point(0, 0)), row_of(probe, floor_point(1, -1)));
}

TEST(LightProbe, WhatSeesNothingIsDark) {
    const scene::Scene scene = floor_and_box(4, {0, 0.5F, 0}, {2, 1, 2});
    const RayCaster caster(scene);
    EXPECT_EQ(squared_length(row_of(LightProbe(caster, white(), {}), floor_point(0, 0))), 0);
}

// The mean square over a thousand natural lights with lamps, whose faces' means stray, is the
// squared length of the row, and the same of the difference of two.
TEST(LightProbe, LengthsAreThoseUnderNaturalLightWithLamps) {
    const scene::Scene scene = floor_and_box(8, {0, 1, 0}, {1, 0.2F, 1});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {.face_resolution = 8, .edge_samples = 0});
    // The response by coefficients, texel by texel, from a caster's single rays.
    const auto projection = basis::CubemapProjection::onto(basis::CubemapBasis::haar(8));
    const LightTexels texels(8, 0);
    const auto coefficients_of = [&](const ProbePoint& point) {
        std::vector<float> response(texels.size());
        for (std::size_t place = 0; place < texels.size(); ++place) {
            const Imath::V3f through = texels.cube_point(place, texels.jitter_column()[place],
                                                         texels.jitter_row()[place]);
            const float cosine = std::max(0.0F, texels.direction_y()[place]);
            if (!caster.is_occluded(point.origins[0], through)) {
                response[texels.texel_index(place)] =
                    cosine * texels.irradiance()[place] / 3.14159265F;
            }
        }
        std::vector<float> coefficients(response.size());
        projection->project_response(response, coefficients);
        return coefficients;
    };
    const ProbePoint lit = floor_point(2, 0);
    const ProbePoint shaded = floor_point(0.3F, 0.1F);
    const auto far_row = coefficients_of(lit);
    const auto near_row = coefficients_of(shaded);
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    double natural = 0;
    const std::vector<float> strays = natural_deviations(projection->basis());
    for (const float stray : strays) {
        natural += double{stray} * stray;
    }
    for (const auto& [index, value] : projection->basis().constant_light()) {
        natural += std::pow(double{LightProbe::kFaceDeviation} * value, 2);
    }
    const auto lamp = static_cast<float>(
        std::sqrt(LightProbe::kLampVariance * natural / static_cast<double>(strays.size())));
    double lit2 = 0;
    double off2 = 0;
    constexpr std::uint64_t kLights = 1000;
    for (std::uint64_t seed = 0; seed < kLights; ++seed) {
        auto light = natural_light(projection->basis(), seed);
        for (const auto& [index, value] : projection->basis().constant_light()) {
            light[index] += LightProbe::kFaceDeviation * value * normal(random);
        }
        for (float& coefficient : light) {
            coefficient += lamp * normal(random);
        }
        const double a = std::inner_product(light.begin(), light.end(), far_row.begin(), 0.0);
        const double b = std::inner_product(light.begin(), light.end(), near_row.begin(), 0.0);
        lit2 += a * a / kLights;
        off2 += (a - b) * (a - b) / kLights;
    }
    const auto far_numbers = row_of(probe, lit);
    auto off = row_of(probe, shaded);
    for (std::size_t i = 0; i < off.size(); ++i) {
        off[i] -= far_numbers[i];
    }
    EXPECT_NEAR(squared_length(far_numbers), lit2, 0.05 * lit2);
    EXPECT_NEAR(squared_length(off), off2, 0.2 * off2);
}

// One term that falls off around the normal as cos θ to a power.
brdf::FactoredBrdf lobe(float power, std::uint32_t terms = 1) {
    brdf::FactoredBrdf brdf;
    constexpr std::uint32_t kRows = 65;
    const brdf::TableShape shape{.rows = kRows, .columns = 1, .depth = terms};
    std::vector<float> values;
    for (std::uint32_t row = 0; row < kRows; ++row) {
        const auto cosine = static_cast<float>(std::cos(shape.theta_from_row(row)));
        for (std::uint32_t term = 0; term < terms; ++term) {
            values.push_back(std::pow(cosine, power * static_cast<float>(term + 1)));
        }
    }
    brdf.name = "lobe";
    brdf.terms = terms;
    brdf.g = brdf::DirectionTable(shape, values);
    brdf.h = brdf::DirectionTable({.rows = 2, .columns = 1, .depth = terms},
                                  std::vector<float>(2 * std::size_t{terms}, 1));
    return brdf;
}

TEST(LightProbe, SquaresOfTermsAddUp) {
    const scene::Scene scene = floor_and_box(8, {0, 1, 0}, {1, 0.2F, 1});
    const RayCaster caster(scene);
    const brdf::FactoredBrdf both = lobe(2, 2);
    const brdf::FactoredBrdf first = lobe(2);
    const brdf::FactoredBrdf second = lobe(4);
    const auto length2 = [&](const brdf::FactoredBrdf& brdf) {
        const std::vector<const brdf::FactoredBrdf*> brdfs{&brdf};
        return squared_length(row_of(LightProbe(caster, brdfs, {}), floor_point(0.3F, 0.1F)));
    };
    const double sum = length2(first) + length2(second);
    EXPECT_NEAR(length2(both), sum, 0.1 * sum);
}

// The narrower a lobe, the more its light changes from normal to normal.
TEST(LightProbe, SharpMaterialsAreRefinedMore) {
    const scene::Scene scene = scene_of({ball_mesh(8)});
    const RayCaster caster(scene);
    const auto vertices = [&](float power) {
        const brdf::FactoredBrdf brdf = lobe(power);
        const std::vector<const brdf::FactoredBrdf*> brdfs{&brdf};
        const LightProbe probe(caster, brdfs, {});
        const RefinedSurface surface =
            refine_surface(scene, probe, {.most_vertices = 5000, .target_error = 0.03});
        EXPECT_TRUE(surface.report.meets_target);
        return surface.vertex_count();
    };
    EXPECT_GT(vertices(32), 4 * vertices(0));
}

TEST(LightProbe, AnUnoccludedPlaneIsNotRefined) {
    const scene::Scene scene = scene_of({square_mesh(20)});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {});
    const RefinedSurface surface =
        refine_surface(scene, probe, {.most_vertices = 5000, .target_error = 0});
    EXPECT_EQ(surface.vertex_count(), surface.report.start_vertices);
}

// Below a tile that floats over a wide floor, triangles are small, and far away they are not.
TEST(LightProbe, APlaneUnderAnOccluderIsRefinedAtTheShadow) {
    const scene::Scene scene = floor_and_box(40, {0, 0.3F, 0}, {2, 0.1F, 2});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {});
    const RefinedSurface surface =
        refine_surface(scene, probe, {.most_vertices = 1500, .target_error = 0});
    expect_lawful(scene, surface);
    expect_no_t_junction(surface);
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < surface.vertex_count(); ++i) {
        const Imath::V3f& p = surface.mesh.positions[i];
        if (p.y != 0 || surface.mesh.normals[i].y < 0) {
            continue;
        }
        float longest = 0;
        for (const VertexNeighbour& neighbour : surface.neighbours_of(i)) {
            longest = std::max(longest, neighbour.distance);
        }
        const float away = std::hypot(p.x, p.z);
        near = away < 1.2F ? std::max(near, longest) : near;
        far = away > 12 ? std::min(far, longest) : far;
    }
    EXPECT_LT(near, 0.5F);
    EXPECT_GT(far, 2.0F);
}

TEST(LightProbe, MoreVerticesLowerTheError) {
    const scene::Scene scene = floor_and_box(12, {0, 0.5F, 0}, {1, 1, 1});
    const RayCaster caster(scene);
    const LightProbe probe(caster, white(), {});
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t most = 200; most <= 1600; most *= 2) {
        const double error =
            refine_surface(scene, probe, {.most_vertices = most, .target_error = 0})
                .report.interpolation_error;
        EXPECT_LT(error, before) << most;
        before = error;
    }
}

}  // namespace
}  // namespace relume::bake
