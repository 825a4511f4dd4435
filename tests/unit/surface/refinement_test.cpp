// Refinement under lights that are formulas: where it splits is then known.
#include "precompute/bake/receivers/vertex/refinement.h"

#include "precompute/bake/base/error.h"
#include "precompute/scene/builtin.h"
#include "tests/unit/surface/small_scenes.h"
#include "tests/unit/surface/surface_laws.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace relume::bake {
namespace {

// A step along a circle around the point (1, 0, 1), and a wave of the normal.
const FormulaProbe& stepped_light() {
    static const FormulaProbe probe([](const ProbePoint& point) {
        const float away = (point.position - Imath::V3f(1, 0, 1)).length();
        return 1 + (away < 1.2F ? 1.0F : 0.0F) + std::sin(3 * point.normal.x);
    });
    return probe;
}

RefinedSurface refined(const scene::Scene& scene,
                       const SurfaceProbe& probe,
                       std::size_t most_vertices,
                       double target_error = 0) {
    return refine_surface(scene, probe,
                          {.most_vertices = most_vertices, .target_error = target_error});
}

void expect_laws(const scene::Scene& scene, std::size_t most_vertices = 700) {
    const RefinedSurface surface = refined(scene, stepped_light(), most_vertices);
    EXPECT_GT(surface.vertex_count(), surface.report.start_vertices);
    EXPECT_LE(surface.vertex_count(), most_vertices);
    expect_lawful(scene, surface);
    expect_no_t_junction(surface);
    expect_closed(surface);
}

TEST(Refinement, LawsHoldOfABox) {
    expect_laws(scene_of({box_mesh({0, 0, 0}, {3, 2, 3})}));
}

TEST(Refinement, LawsHoldOfABallAndOfFacets) {
    scene::Scene scene = scene_of({ball_mesh(12)});
    expect_laws(scene);
    scene.meshes[0].normals.clear();
    expect_laws(scene);
}

TEST(Refinement, LawsHoldOfASheet) {
    expect_laws(scene_of({square_mesh(4)}));
}

TEST(Refinement, LawsHoldOfOneTriangle) {
    scene::Mesh mesh = square_mesh(4);
    mesh.triangles.pop_back();
    expect_laws(scene_of({mesh}));
}

TEST(Refinement, LawsHoldWhereMaterialsMeet) {
    scene::Mesh right = square_mesh(4);
    right.material = 1;
    for (Imath::V3f& position : right.positions) {
        position.x += 4;
    }
    expect_laws(scene_of({square_mesh(4), right}, 2));
}

TEST(Refinement, LawsHoldOfAnEdgeOfThreeTriangles) {
    expect_laws(scene_of({book_mesh()}));
}

TEST(Refinement, LawsHoldOfDoublesAndTrianglesWithoutArea) {
    scene::Scene scene = scene_of({square_mesh(4)});
    scene.meshes[0].triangles.push_back(scene.meshes[0].triangles[0]);
    scene.meshes[0].triangles.push_back({0, 1, 1});
    expect_laws(scene);
}

// Boxes that touch, spheres, tubes: all of it is closed, and has one side.
TEST(Refinement, LawsHoldOfTheStreet) {
    const scene::Scene scene = scene::build_builtin_scene("street");
    const RefinedSurface surface = refined(scene, stepped_light(), 15'000);
    EXPECT_EQ(surface.report.two_sided_triangles, 0U);
    EXPECT_LT(surface.report.start_vertices, 10'000U);
    expect_lawful(scene, surface);
}

// Each corner of a box has three normals, and so has each new vertex at an edge two.
TEST(Refinement, CreasesStay) {
    const scene::Scene scene = scene_of({box_mesh({0, 0, 0}, {3, 2, 3})});
    const RefinedSurface surface = refined(scene, stepped_light(), 700);
    for (const auto& triangle : surface.mesh.triangles) {
        const auto& p = surface.mesh.positions;
        const auto& [a, b, c] = triangle.vertices;
        const Imath::V3f face = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
        for (const std::uint32_t vertex : triangle.vertices) {
            ASSERT_GT(surface.mesh.normals[vertex].dot(face), 0.9999F);
        }
    }
}

TEST(Refinement, NormalsAreInterpolatedAsTheScenesAre) {
    const scene::Scene scene = scene_of({ball_mesh(12)});
    const RefinedSurface surface = refined(scene, stepped_light(), 700);
    const scene::Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < surface.origins.size(); ++i) {
        const TriangleOrigin& origin = surface.origins[i];
        const scene::Triangle& whole = mesh.triangles[origin.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const Imath::V2f& at = origin.barycentrics[k];
            const Imath::V3f expected =
                (mesh.normals[whole[0]] * (1 - at.x - at.y) + mesh.normals[whole[1]] * at.x +
                 mesh.normals[whole[2]] * at.y)
                    .normalized();
            const Imath::V3f& found =
                surface.mesh.normals[surface.mesh.triangles[i].vertices[k]];
            ASSERT_LT((found - expected).length(), 0.01F);  // within what is one normal
        }
    }
}

TEST(Refinement, WhatIsLinearIsNotRefined) {
    const FormulaProbe linear(
        [](const ProbePoint& point) { return 2 + point.position.x - 0.5F * point.position.z; });
    const scene::Scene scene = scene_of({square_mesh(4), box_mesh({0, 5, 0}, {1, 1, 1})});
    const RefinedSurface surface = refined(scene, linear, 10'000, 1e-4);
    EXPECT_EQ(surface.vertex_count(), surface.report.start_vertices);
    EXPECT_TRUE(surface.report.meets_target);
    expect_lawful(scene, surface);
}

TEST(Refinement, DarknessIsNotRefined) {
    const FormulaProbe dark([](const ProbePoint&) { return 0.0F; });
    const RefinedSurface surface = refined(scene_of({square_mesh(4)}), dark, 1000);
    EXPECT_EQ(surface.vertex_count(), surface.report.start_vertices);
    EXPECT_EQ(surface.report.interpolation_error, 0);
}

// A disc of shadow, a twelfth of the square wide and in the middle of nothing.
TEST(Refinement, ASmallShadowIsFoundAndNothingElse) {
    const Imath::V3f middle(1.3F, 0, 0.7F);
    const FormulaProbe shadow([&](const ProbePoint& point) {
        return (point.position - middle).length() < 0.5F && point.normal.y > 0 ? 0.0F : 1.0F;
    });
    const RefinedSurface surface = refined(scene_of({square_mesh(12)}), shadow, 3000);
    const auto longest_edges = [&](float low, float high) {
        float longest = 0;
        for (std::size_t i = 0; i < surface.vertex_count(); ++i) {
            const float away = (surface.mesh.positions[i] - middle).length();
            if (away >= low && away < high) {
                for (const VertexNeighbour& neighbour : surface.neighbours_of(i)) {
                    longest = std::max(longest, neighbour.distance);
                }
            }
        }
        return longest;
    };
    EXPECT_LT(longest_edges(0.49F, 0.51F), 0.1F);
    EXPECT_GT(longest_edges(3, 20), 1.0F);
    const auto near_edge = std::count_if(
        surface.mesh.positions.begin(), surface.mesh.positions.end(),
        [&](const Imath::V3f& p) { return std::abs((p - middle).length() - 0.5F) < 0.1F; });
    EXPECT_GT(near_edge, static_cast<std::ptrdiff_t>(surface.vertex_count()) * 8 / 10);
}

TEST(Refinement, MoreVerticesNeverRaiseTheError) {
    const scene::Scene scene =
        scene_of({box_mesh({0, 0, 0}, {3, 2, 3}), square_mesh(8), ball_mesh(12)});
    const FormulaProbe smooth([](const ProbePoint& point) {
        return 2 + std::sin(2 * point.position.x) * std::cos(point.position.z) +
               point.normal.x * point.normal.y;
    });
    for (const SurfaceProbe* probe : {&stepped_light(), &smooth}) {
        double before = std::numeric_limits<double>::infinity();
        for (std::size_t most = 250; most <= 8000; most *= 2) {
            const double error = refined(scene, *probe, most).report.interpolation_error;
            EXPECT_LT(error, before) << most;
            before = error;
        }
        EXPECT_LT(before, 0.04);
    }
}

TEST(Refinement, TheErrorStatedIsTheErrorThatThereIs) {
    const FormulaProbe wave([](const ProbePoint& point) {
        return 1 + 0.5F * std::sin(2 * point.position.x + point.position.z);
    });
    const RefinedSurface surface = refined(scene_of({square_mesh(6)}), wave, 600);
    // A lattice of places in every triangle.
    double error2 = 0;
    double energy = 0;
    for (const auto& triangle : surface.mesh.triangles) {
        std::array<Imath::V3f, 3> p;
        std::array<float, 3> at_corner{};
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = surface.mesh.positions[triangle.vertices[k]];
            at_corner[k] = 1 + 0.5F * std::sin(2 * p[k].x + p[k].z);
        }
        const double area = (p[1] - p[0]).cross(p[2] - p[0]).length() / 2;
        constexpr int kSide = 12;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; i + j < kSide; ++j) {
                const float x = (static_cast<float>(i) + 1.0F / 3) / kSide;
                const float y = (static_cast<float>(j) + 1.0F / 3) / kSide;
                const Imath::V3f place = p[0] * (1 - x - y) + p[1] * x + p[2] * y;
                const double truth = 1 + 0.5F * std::sin(2 * place.x + place.z);
                const double off =
                    at_corner[0] * (1 - x - y) + at_corner[1] * x + at_corner[2] * y - truth;
                error2 += area * off * off;
                energy += area * truth * truth;
            }
        }
    }
    EXPECT_NEAR(surface.report.interpolation_error, std::sqrt(error2 / energy),
                0.15 * std::sqrt(error2 / energy));
}

TEST(Refinement, StopsAtTheTarget) {
    const scene::Scene scene = scene_of({square_mesh(8)});
    std::size_t before = 0;
    for (const double target : {0.1, 0.05, 0.025}) {
        const RefinedSurface surface = refined(scene, stepped_light(), 20'000, target);
        EXPECT_TRUE(surface.report.meets_target);
        EXPECT_LE(surface.report.interpolation_error, target);
        EXPECT_GT(surface.report.interpolation_error, target / 4);
        EXPECT_GT(surface.vertex_count(), before);
        before = surface.vertex_count();
    }
    EXPECT_FALSE(refined(scene, stepped_light(), 100, 0.001).report.meets_target);
}

// Bisection of longest edges keeps angles at half of what they were, at least.
TEST(Refinement, AnglesStay) {
    const scene::Scene scene = scene_of({square_mesh(8)});
    const RefinedSurface surface = refined(scene, stepped_light(), 4000);
    for (const auto& triangle : surface.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = [&](std::size_t i) {
                return surface.mesh.positions[triangle.vertices[(k + i) % 3]];
            };
            const Imath::V3f a = at(1) - at(0);
            const Imath::V3f b = at(2) - at(0);
            ASSERT_GT(std::atan2(a.cross(b).length(), a.dot(b)), 0.39F);  // of 45° = 0.785
        }
    }
}

// A long thin tube under light that the normal alone decides. Its triangles are four hundred
// times as long as they are wide, and vertices along the tube show nothing new.
TEST(Refinement, ATubeIsSplitAroundIt) {
    scene::MeshBuilder builder("tube", 0);
    builder.add_tube({{{0, 0, 0}, 0.02F}, {{0, 3, 0}, 0.02F}}, 16, scene::Closing::open);
    const scene::Scene scene = scene_of({builder.take()});
    const FormulaProbe highlight([](const ProbePoint& point) {
        return std::pow(std::max(0.0F, point.normal.x), 100.0F);
    });
    const RefinedSurface surface = refined(scene, highlight, 20'000, 0.03);
    EXPECT_TRUE(surface.report.meets_target);
    EXPECT_LT(surface.vertex_count(), 60 * surface.report.start_vertices);
}

TEST(Refinement, ThreadsChangeNothing) {
    const scene::Scene scene = scene_of({box_mesh({0, 0, 0}, {3, 2, 3}), ball_mesh(16)});
    const auto with_threads = [&](std::size_t threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          threads);
        return refined(scene, stepped_light(), 2000);
    };
    const RefinedSurface one = with_threads(1);
    const RefinedSurface many = with_threads(4);
    EXPECT_EQ(one.mesh, many.mesh);
    EXPECT_EQ(one.clusters, many.clusters);
    EXPECT_EQ(one.report.interpolation_error, many.report.interpolation_error);
    EXPECT_EQ(one.report.rays, many.report.rays);
}

// What cannot be interpolated is split down to where floats end, and no further.
TEST(Refinement, EndsWhereNoEdgeCanBeSplit) {
    const FormulaProbe rough(
        [](const ProbePoint& point) { return point.position.x < 0.1F ? 1.0F : 2.0F; });
    scene::Mesh mesh = square_mesh(1e-3F);
    for (Imath::V3f& position : mesh.positions) {
        position.x += 0.1F;
        position.y += 8;
    }
    const scene::Scene scene = scene_of({mesh});
    const RefinedSurface surface = refined(scene, rough, 100'000);
    EXPECT_LT(surface.vertex_count(), 1000U);
    EXPECT_FALSE(surface.report.meets_target);
    expect_lawful(scene, surface);
}

TEST(Refinement, OptionsOutOfRangeAreRefused) {
    const scene::Scene scene = scene_of({square_mesh(4)});
    EXPECT_THROW((void)refined(scene, stepped_light(), 2), BakeError);
    EXPECT_THROW((void)refined(scene, stepped_light(), kMostSurfaceVertices + 1), BakeError);
    EXPECT_THROW((void)refined(scene, stepped_light(), 100, -1), BakeError);
    EXPECT_THROW(
        (void)refined(scene, stepped_light(), 100, std::numeric_limits<double>::quiet_NaN()),
        BakeError);
}

}  // namespace
}  // namespace relume::bake
