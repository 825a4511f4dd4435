#include "precompute/scene/builtin.h"

#include "precompute/scene/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

// Built once for all the tests that only look.
const Scene& built(std::string_view name) {
    static std::map<std::string_view, Scene> scenes;
    const auto place = scenes.find(name);
    return place != scenes.end()
               ? place->second
               : scenes.emplace(name, build_builtin_scene(name)).first->second;
}

class EveryBuiltin : public testing::TestWithParam<BuiltinScene> {};

INSTANTIATE_TEST_SUITE_P(Scenes,
                         EveryBuiltin,
                         testing::ValuesIn(builtin_scenes()),
                         [](const auto& param_info) {
                             return std::string(param_info.param.name);
                         });

TEST_P(EveryBuiltin, IsCompleteAndNeedsNoRepair) {
    const Scene& scene = built(GetParam().name);
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_GT(scene.triangle_count(), 0U);
    EXPECT_TRUE(scene.report.unused.empty());
    EXPECT_TRUE(scene.report.repairs.empty());
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(mesh.material, scene.materials.size());
        for (const Imath::V3f& normal : mesh.normals)
            ASSERT_NEAR(normal.length(), 1.0F, 1e-3F);
    }
    EXPECT_NO_THROW(Camera(scene.camera, 64, 64));
}

TEST_P(EveryBuiltin, IsTheSameEveryTime) {
    const Scene& a = built(GetParam().name);
    const Scene b = GetParam().build();
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i) {
        ASSERT_EQ(a.meshes[i].positions.size(), b.meshes[i].positions.size());
        EXPECT_EQ(std::memcmp(a.meshes[i].positions.data(), b.meshes[i].positions.data(),
                              a.meshes[i].positions.size() * sizeof(Imath::V3f)),
                  0);
        EXPECT_EQ(a.meshes[i].triangles, b.meshes[i].triangles);
    }
}

// A normal that points against its triangle would turn the shading inside out.
TEST_P(EveryBuiltin, NormalsGoWithTheirTriangles) {
    const Scene& scene = built(GetParam().name);
    std::size_t against = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (mesh.normals.empty())
            continue;
        for (const Triangle& t : mesh.triangles) {
            const Imath::V3f face = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                        .cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
            const Imath::V3f mean =
                mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
            against += face.dot(mean) <= 0 ? 1U : 0U;
        }
    }
    EXPECT_LE(against, scene.triangle_count() / 1000);
}

TEST(Builtin, UnknownNameSaysWhichExist) {
    try {
        (void)build_builtin_scene("teapot");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.fault(), SceneFault::unknown_name);
        EXPECT_NE(std::string(error.what()).find("table"), std::string::npos);
    }
}

TEST(Builtin, Mesh100kIsAClosedMeshOfOverAHundredThousandTriangles) {
    const Scene& scene = built("mesh100k");
    const Mesh& ball = scene.meshes.at(1);
    EXPECT_EQ(ball.triangles.size(), 100800U);
    // Closed: every edge, by position, is used once in each sense.
    using Point = std::array<float, 3>;
    std::map<std::pair<Point, Point>, int> edges;
    const auto point = [&](std::uint32_t i) {
        const Imath::V3f& p = ball.positions[i];
        return Point{p.x, p.y, p.z};
    };
    for (const Triangle& t : ball.triangles) {
        for (std::size_t k = 0; k < 3; ++k)
            ++edges[{point(t[k]), point(t[(k + 1) % 3])}];
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1);
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
}

TEST(Builtin, TableHasAPlantAndGlossyThings) {
    const Scene& scene = built("table");
    std::size_t leaf_triangles = 0;
    std::set<BsdfModel> models;
    for (const Mesh& mesh : scene.meshes) {
        leaf_triangles += mesh.name == "leaves" ? mesh.triangles.size() : 0;
        models.insert(scene.materials[mesh.material].model);
    }
    EXPECT_GT(leaf_triangles / 48, 300U);  // 48 triangles a leaf
    EXPECT_EQ(models.count(BsdfModel::ggx), 1U);
    EXPECT_EQ(models.count(BsdfModel::lambert), 1U);
}

// Every mesh of the street is closed and faces outwards: its edges, by position, run as often
// one way as the other, and what it encloses is a volume above zero.
TEST(Builtin, StreetIsClosedAndFacesOutwards) {
    using Point = std::array<float, 3>;
    const Scene& scene = built("street");
    std::set<BsdfModel> models;
    for (const Mesh& mesh : scene.meshes) {
        models.insert(scene.materials[mesh.material].model);
        std::map<std::pair<Point, Point>, int> edges;
        double volume = 0;
        const auto point = [&](std::uint32_t i) {
            const Imath::V3f& p = mesh.positions[i];
            return Point{p.x, p.y, p.z};
        };
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                ++edges[{point(t[k]), point(t[(k + 1) % 3])}];
                --edges[{point(t[(k + 1) % 3]), point(t[k])}];
            }
            volume += Imath::V3d(mesh.positions[t[0]])
                          .dot(Imath::V3d(mesh.positions[t[1]])
                                   .cross(Imath::V3d(mesh.positions[t[2]]))) /
                      6;
        }
        for (const auto& [edge, balance] : edges)
            ASSERT_EQ(balance, 0) << mesh.name;
        EXPECT_GT(volume, 0) << mesh.name;
    }
    EXPECT_EQ(models, (std::set{BsdfModel::lambert, BsdfModel::phong, BsdfModel::ggx}));
}

// The pearls lie on the cloth, and it lies on the pedestal: a pearl touches it without sinking
// in by more than a third of a millimetre, and no point of it is below the pedestal's top
// within its rim.
TEST(Builtin, PearlsLieOnTheCloth) {
    const Scene& scene = built("earrings");
    std::map<std::string, const Mesh*> by_name;
    for (const Mesh& mesh : scene.meshes)
        by_name[mesh.name] = &mesh;
    const Mesh& cloth = *by_name.at("cloth");
    EXPECT_NEAR(static_cast<double>(cloth.triangles.size()), 20'000, 2'000);
    for (const char* name : {"pearl", "post", "cloth"})
        EXPECT_TRUE(
            std::any_of(scene.materials.begin(), scene.materials.end(),
                        [&](const Material& material) { return material.name == name; }))
            << name;
    constexpr float kRadius = 0.0075F;
    const std::vector<Imath::V3f>& pearls = by_name.at("pearls")->positions;
    for (const std::size_t first : {std::size_t{0}, pearls.size() / 2}) {
        // A pearl's first ring is its south pole, its last the north pole.
        const Imath::V3f centre = pearls[first] + Imath::V3f(0, kRadius, 0);
        float nearest = 1;
        for (const Imath::V3f& point : cloth.positions)
            nearest = std::min(nearest, (point - centre).length());
        EXPECT_LE(nearest, kRadius);
        EXPECT_GT(nearest, kRadius - 0.00035F);
    }
    float top = 0;
    for (const Imath::V3f& point : by_name.at("pedestal")->positions)
        top = std::max(top, point.y);
    for (const Imath::V3f& point : cloth.positions) {
        if (std::hypot(point.x, point.z) < 0.04F) {
            ASSERT_GT(point.y, top);
        }
    }
}

TEST(Builtin, BowlIsWhiteAndFlat) {
    const Scene& scene = built("bowl");
    EXPECT_EQ(scene.materials[0].base_colour, Imath::V3f(1));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
}

}  // namespace
}  // namespace relume::scene
