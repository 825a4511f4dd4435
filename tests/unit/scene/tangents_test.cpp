#include "precompute/scene/tangents.h"

#include "tests/support/reference_tracer/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::scene {
namespace {

// Two triangles that share the edge x = 0; the right one's texture mirrors the left one's.
Mesh mirrored_pair() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
    mesh.normals.assign(4, Imath::V3f(0, 0, 1));
    mesh.uvs = {{1, 0}, {1, 1}, {0, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
    return mesh;
}

Imath::V3f xyz(const Imath::V4f& v) {
    return {v.x, v.y, v.z};
}

TEST(Tangents, MirroredHalvesKeepTheirOwn) {
    Mesh mesh = mirrored_pair();
    add_tangents(mesh, 0);
    ASSERT_EQ(mesh.positions.size(), 6U);  // the shared edge has two tangents
    for (const std::uint32_t corner : mesh.triangles[0])
        EXPECT_EQ(mesh.tangents[corner], Imath::V4f(1, 0, 0, 1));
    for (const std::uint32_t corner : mesh.triangles[1])
        EXPECT_EQ(mesh.tangents[corner], Imath::V4f(-1, 0, 0, -1));
}

TEST(Tangents, OfAFlatMeshBelongToItsFaces) {
    Mesh mesh = mirrored_pair();
    mesh.normals.clear();
    mesh.colours.assign(4, Imath::V3f(0.5F));
    mesh.more_uvs.assign(1, mesh.uvs);
    add_tangents(mesh, 1);
    EXPECT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.colours.size(), 6U);
    EXPECT_EQ(mesh.more_uvs[0].size(), 6U);
    EXPECT_EQ(mesh.positions[mesh.triangles[1][1]], Imath::V3f(1, 0, 0));
    EXPECT_EQ(mesh.tangents[mesh.triangles[0][0]], Imath::V4f(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[mesh.triangles[1][0]], Imath::V4f(-1, 0, 0, -1));
}

// Whatever the triangle: the tangent goes with u, and w·normal×tangent with v.
TEST(Tangents, FollowTheTextureOnAnyTriangle) {
    reference::Random random(5);
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    for (int i = 0; i < 1000; ++i) {
        Mesh mesh;
        for (int k = 0; k < 3; ++k) {
            mesh.positions.emplace_back(number(), number(), number());
            mesh.uvs.emplace_back(number(), number());
        }
        mesh.triangles = {{0, 1, 2}};
        const Imath::V3f face = (mesh.positions[1] - mesh.positions[0])
                                    .cross(mesh.positions[2] - mesh.positions[0]);
        mesh.normals.assign(3, face.normalized() * (i % 2 == 0 ? 1.0F : -1.0F));
        add_tangents(mesh, 0);
        const Imath::V4f tangent = mesh.tangents[0];
        const Imath::V3f t = xyz(tangent);
        const Imath::V3f b = mesh.normals[0].cross(t) * tangent.w;
        ASSERT_NEAR(t.length(), 1.0F, 1e-5F);
        ASSERT_NEAR(t.dot(mesh.normals[0]), 0.0F, 1e-4F);
        // Position is an affine function of uv: its derivative along u is along t, and that
        // along v on b's side.
        const Imath::V2f d1 = mesh.uvs[1] - mesh.uvs[0];
        const Imath::V2f d2 = mesh.uvs[2] - mesh.uvs[0];
        const float det = d1.x * d2.y - d1.y * d2.x;
        const Imath::V3f e1 = mesh.positions[1] - mesh.positions[0];
        const Imath::V3f e2 = mesh.positions[2] - mesh.positions[0];
        const Imath::V3f along_u = (e1 * d2.y - e2 * d1.y) / det;
        const Imath::V3f along_v = (e2 * d1.x - e1 * d2.x) / det;
        ASSERT_NEAR(along_u.normalized().dot(t), 1.0F, 1e-3F);
        ASSERT_GT(along_v.dot(b), 0.0F);
    }
}

TEST(Tangents, AreZeroWhereTheCoordinatesSpanNothing) {
    Mesh mesh = mirrored_pair();
    mesh.uvs.assign(4, Imath::V2f(0.5F, 0.5F));
    add_tangents(mesh, 0);
    EXPECT_EQ(xyz(mesh.tangents[0]), Imath::V3f(0));
}

// Vertices that a file writes once for each triangle are smooth all the same.
TEST(Tangents, DoNotDependOnHowVerticesAreShared) {
    Mesh shared = mirrored_pair();
    shared.uvs = {{1, 0}, {1, 1}, {0, 0}, {1.5F, 0.5F}};
    Mesh apart = shared;
    apart.positions.clear();
    apart.normals.clear();
    apart.uvs.clear();
    for (Triangle& triangle : apart.triangles) {
        for (std::uint32_t& corner : triangle) {
            apart.positions.push_back(shared.positions[corner]);
            apart.normals.push_back(shared.normals[corner]);
            apart.uvs.push_back(shared.uvs[corner]);
            corner = static_cast<std::uint32_t>(apart.positions.size() - 1);
        }
    }
    add_tangents(shared, 0);
    add_tangents(apart, 0);
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(shared.tangents[shared.triangles[t][k]],
                      apart.tangents[apart.triangles[t][k]]);
    }
}

}  // namespace
}  // namespace relume::scene
