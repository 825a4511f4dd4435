// The places around a vertex lie on the triangles at it, and the tables of who is whose
// neighbour say what the triangles say.
#include "precompute/bake/receivers/vertex/vertex_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace relume::bake {
namespace {

// A square of two triangles, folded up by 90° along its diagonal at the third corner.
scene::Scene folded_square() {
    scene::Scene scene;
    scene.materials.push_back({.name = "white"});
    scene::Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 0, -2}, {0, 1, -2}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.meshes.push_back(mesh);
    return scene;
}

RefinedSurface surface_of(const scene::Scene& scene) {
    RefinedSurface surface;
    const scene::Mesh& mesh = scene.meshes[0];
    surface.mesh.positions = mesh.positions;
    surface.mesh.normals.assign(mesh.positions.size(), {0, 1, 0});
    surface.mesh.uvs = {{0, 0}};
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        surface.mesh.triangles.push_back({.vertices = mesh.triangles[i]});
        surface.origins.push_back(
            {.mesh = 0, .triangle = i, .barycentrics = {{{0, 0}, {1, 0}, {0, 1}}}});
    }
    surface.clusters = {{.first = 0, .count = 4}};
    connect(surface);
    return surface;
}

TEST(Connect, NeighboursAndTrianglesAreThoseOfTheMesh) {
    const RefinedSurface surface = surface_of(folded_square());
    const auto neighbours = [&](std::size_t vertex) {
        std::set<std::uint32_t> set;
        for (const VertexNeighbour& neighbour : surface.neighbours_of(vertex)) {
            set.insert(neighbour.vertex);
            EXPECT_FLOAT_EQ(neighbour.distance, (surface.mesh.positions[neighbour.vertex] -
                                                 surface.mesh.positions[vertex])
                                                    .length());
        }
        EXPECT_EQ(set.size(), surface.neighbours_of(vertex).size());
        return set;
    };
    EXPECT_EQ(neighbours(0), (std::set<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(neighbours(1), (std::set<std::uint32_t>{0, 2}));
    EXPECT_EQ(neighbours(2), (std::set<std::uint32_t>{0, 1, 3}));
    EXPECT_EQ(neighbours(3), (std::set<std::uint32_t>{0, 2}));
    EXPECT_EQ(surface.triangles_of(0).size(), 2U);
    EXPECT_EQ(surface.triangles_of(3)[0], 1U);
}

TEST(Connect, AreasOfVerticesSumToTheSurface) {
    const RefinedSurface surface = surface_of(folded_square());
    const float first = 2;  // of the flat triangle
    EXPECT_FLOAT_EQ(surface.areas[1], first / 3);
    const Imath::V3f b(2, 0, -2);
    const Imath::V3f c(0, 1, -2);
    const float second = 0.5F * b.cross(c).length();
    EXPECT_FLOAT_EQ(surface.areas[0], (first + second) / 3);
    EXPECT_FLOAT_EQ(surface.areas[3], second / 3);
}

TEST(PlacesOfVertex, LieJustInsideTheTrianglesAroundIt) {
    const scene::Scene scene = folded_square();
    const RefinedSurface surface = surface_of(scene);
    for (std::size_t vertex = 0; vertex < surface.vertex_count(); ++vertex) {
        std::set<std::uint32_t> triangles;
        for (const SurfacePlace& place : places_of_vertex(surface, vertex)) {
            triangles.insert(place.triangle);
            const Imath::V2f& b = place.barycentric;
            EXPECT_GT(b.x, 0);
            EXPECT_GT(b.y, 0);
            EXPECT_GT(1 - b.x - b.y, 0);
            const Imath::V3f position = surface_point_at(scene, place).position;
            const float away = (position - surface.mesh.positions[vertex]).length();
            EXPECT_GT(away, 0);
            EXPECT_LE(away, kPlaceInset * 3);
        }
        const auto around = surface.triangles_of(vertex);
        EXPECT_EQ(triangles, std::set<std::uint32_t>(around.begin(), around.end()));
    }
}

// The flat triangle has 45° at vertex 0, and the other one its angle of about 42°: eight places
// and eight, and of any aligned four two and two.
TEST(PlacesOfVertex, AreSharedOutByAngle) {
    const RefinedSurface surface = surface_of(folded_square());
    const auto places = places_of_vertex(surface, 0);
    for (std::size_t first = 0; first < places.size(); first += 4) {
        EXPECT_EQ(std::count_if(&places[first], &places[first] + 4,
                                [](const SurfacePlace& place) { return place.triangle == 0; }),
                  2);
    }
}

TEST(SurfacePointAt, LooksFromTheSideOfThePlace) {
    const scene::Scene scene = folded_square();
    SurfacePlace place{.mesh = 0, .triangle = 0, .barycentric = {0.25F, 0.25F}};
    EXPECT_EQ(surface_point_at(scene, place).geometric_normal, Imath::V3f(0, 1, 0));
    EXPECT_EQ(surface_point_at(scene, place).shading.normal, Imath::V3f(0, 1, 0));
    place.is_behind = true;
    EXPECT_EQ(surface_point_at(scene, place).geometric_normal, Imath::V3f(0, -1, 0));
    EXPECT_EQ(surface_point_at(scene, place).shading.normal, Imath::V3f(0, -1, 0));
    EXPECT_FLOAT_EQ(surface_point_at(scene, place).wo.z, 1);
}

}  // namespace
}  // namespace relume::bake
