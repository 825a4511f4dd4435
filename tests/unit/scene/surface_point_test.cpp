#include "precompute/scene/surface_point.h"

#include "tests/support/reference_tracer/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

using reference::Random;

// The right triangle (0,0), (1,0), (0,1) in the plane z = 0.
Scene one_triangle(Material material) {
    Scene scene;
    scene.name = "triangle";
    scene.materials.push_back(std::move(material));
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

Imath::V3f any_direction(Random& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double phi = 6.283185307 * random.uniform();
    const double r = std::sqrt(1.0 - z * z);
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
            static_cast<float>(z)};
}

TEST(Frame, IsOrthonormalForEveryNormal) {
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const Imath::V3f n = i == 0 ? Imath::V3f(0, 0, -1) : any_direction(random);
        const Frame frame = Frame::from_normal(n);
        EXPECT_NEAR(frame.tangent.length(), 1.0F, 1e-5F);
        EXPECT_NEAR(frame.tangent.dot(n), 0.0F, 1e-5F);
        EXPECT_LT((frame.tangent.cross(frame.bitangent) - n).length(), 1e-5F);
        const Imath::V3f w = any_direction(random);
        EXPECT_LT((frame.to_world(frame.to_local(w)) - w).length(), 1e-5F);
    }
}

TEST(SurfacePoint, LiesWhereTheBarycentricsSay) {
    const Scene scene = one_triangle({.base_colour = {0.4F, 0.4F, 0.4F}});
    const SurfacePoint point = surface_point(scene, 0, 0, {0.25F, 0.5F}, {0, 0, -1});
    EXPECT_EQ(point.position, Imath::V3f(0.25F, 0.5F, 0));
    EXPECT_EQ(point.geometric_normal, Imath::V3f(0, 0, 1));
}

TEST(SurfacePoint, IsTwoSided) {
    const Scene scene = one_triangle({.base_colour = {0.4F, 0.4F, 0.4F}});
    const SurfacePoint front = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, -1});
    const SurfacePoint back = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, 1});
    EXPECT_EQ(back.geometric_normal, -front.geometric_normal);
    EXPECT_EQ(front.reflect({0, 0, 1}), back.reflect({0, 0, -1}));
    EXPECT_EQ(front.reflect({0, 0, -1}), Imath::V3f(0));
}

// Light that would come through the surface is refused even where the interpolated normal
// tilts far enough to see it.
TEST(SurfacePoint, LeaksNoLightFromBelowTheSurface) {
    for (const BsdfModel model : {BsdfModel::lambert, BsdfModel::phong, BsdfModel::ggx}) {
        Scene scene = one_triangle({.model = model,
                                    .base_colour = {0.5F, 0.5F, 0.5F},
                                    .specular = {0.4F, 0.4F, 0.4F},
                                    .exponent = 8,
                                    .roughness = 0.5F});
        scene.meshes[0].normals.assign(3, Imath::V3f(0.9F, 0, 0.44F).normalized());
        const SurfacePoint point = surface_point(scene, 0, 0, {0.2F, 0.2F}, {-0.3F, 0.1F, -1});
        const Imath::V3f below = Imath::V3f(1, 0, -0.1F).normalized();
        ASSERT_GT(below.dot(point.shading.normal), 0.3F);
        EXPECT_EQ(point.reflect(below), Imath::V3f(0));
        Random random(2);
        for (int i = 0; i < 500; ++i) {
            const auto sample = point.sample(
                static_cast<float>(random.uniform()),
                {static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
            if (sample.weight != Imath::V3f(0)) {
                ASSERT_GT(sample.wi.z, 0.0F);
            }
        }
    }
}

TEST(SurfacePoint, ViewerIsNeverBelowTheShadingHorizon) {
    Scene scene = one_triangle({});
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        scene.meshes[0].normals.assign(3, any_direction(random));
        const SurfacePoint point =
            surface_point(scene, 0, 0, {0.3F, 0.3F}, any_direction(random));
        ASSERT_GT(point.wo.z, 0.0F);
        ASSERT_NEAR(point.wo.length(), 1.0F, 1e-4F);
        ASSERT_NEAR(point.shading.normal.length(), 1.0F, 1e-4F);
    }
}

TEST(SurfacePoint, ManyDirectionsAreAsOne) {
    Random random(4);
    for (const BsdfModel model : {BsdfModel::lambert, BsdfModel::phong, BsdfModel::ggx}) {
        Scene scene = one_triangle({.model = model,
                                    .base_colour = {0.5F, 0.3F, 0.2F},
                                    .specular = {0.4F, 0.4F, 0.4F},
                                    .exponent = 20,
                                    .roughness = 0.4F});
        scene.meshes[0].normals.assign(3, Imath::V3f(0.3F, 0.2F, 0.9F).normalized());
        const SurfacePoint point = surface_point(scene, 0, 0, {0.2F, 0.2F}, {-0.3F, 0.1F, -1});
        constexpr std::size_t kCount = 777;
        std::vector<float> x(kCount);
        std::vector<float> y(kCount);
        std::vector<float> z(kCount);
        std::vector<float> r(kCount);
        std::vector<float> g(kCount);
        std::vector<float> b(kCount);
        for (std::size_t i = 0; i < kCount; ++i) {
            const Imath::V3f w = any_direction(random);
            x[i] = w.x;
            y[i] = w.y;
            z[i] = w.z;
        }
        point.reflect({x, y, z}, {r, g, b});
        for (std::size_t i = 0; i < kCount; ++i) {
            const Imath::V3f one = point.reflect({x[i], y[i], z[i]});
            ASSERT_NEAR(r[i], one.x, 1e-5F * one.x + 1e-7F);
            ASSERT_NEAR(g[i], one.y, 1e-5F * one.y + 1e-7F);
            ASSERT_NEAR(b[i], one.z, 1e-5F * one.z + 1e-7F);
        }
    }
}

TEST(SurfacePoint, LooksTexturesUpWhereItIs) {
    Scene scene = one_triangle({.base_colour = {1, 1, 1}, .base_texture = 0});
    scene.textures.emplace_back("two", 2, 1,
                                std::vector<half>{half(1), half(0), half(0), half(1), half(0),
                                                  half(1), half(0), half(0)});
    const SurfacePoint left = surface_point(scene, 0, 0, {0.25F, 0.1F}, {0, 0, -1});
    const SurfacePoint right = surface_point(scene, 0, 0, {0.75F, 0.1F}, {0, 0, -1});
    EXPECT_EQ(left.bsdf.diffuse_colour(), Imath::V3f(1, 0, 0));
    EXPECT_EQ(right.bsdf.diffuse_colour(), Imath::V3f(0, 1, 0));
    // The second texel's alpha is 0: a hole once the material asks for holes.
    EXPECT_TRUE(is_solid_at(scene, 0, 0, {0.75F, 0.1F}));
    EXPECT_FALSE(has_holes(scene));
    scene.materials[0].alpha_cutoff = 0.5F;
    EXPECT_TRUE(has_holes(scene));
    EXPECT_FALSE(is_solid_at(scene, 0, 0, {0.75F, 0.1F}));
    EXPECT_TRUE(is_solid_at(scene, 0, 0, {0.25F, 0.1F}));
}

TEST(SurfacePoint, NormalMapTiltsAlongTheTextureAxes) {
    Scene scene = one_triangle({.base_colour = {1, 1, 1}, .normal_texture = 0});
    // (0.8, 0.5, 0.9…) is tilted towards +u, which is +X here.
    scene.textures.emplace_back("normal", 1, 1,
                                std::vector<half>{half(0.8F), half(0.5F), half(0.9F), half(1)});
    finish_scene(scene);
    const SurfacePoint point = surface_point(scene, 0, 0, {0.2F, 0.2F}, {0, 0, -1});
    const Imath::V3f expected = Imath::V3f(0.6F, 0, 0.8F).normalized();
    EXPECT_LT((point.shading.normal - expected).length(), 2e-3F);
    EXPECT_EQ(point.geometric_normal, Imath::V3f(0, 0, 1));
}

TEST(SurfacePoint, VertexColoursMultiply) {
    Scene scene = one_triangle({.base_colour = {1, 0.5F, 1}});
    scene.meshes[0].colours = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const SurfacePoint point = surface_point(scene, 0, 0, {0.25F, 0.5F}, {0, 0, -1});
    EXPECT_LT((point.bsdf.diffuse_colour() - Imath::V3f(0.25F, 0.125F, 0.5F)).length(), 1e-6F);
}

}  // namespace
}  // namespace relume::scene
