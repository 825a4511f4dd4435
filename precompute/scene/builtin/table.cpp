#include "precompute/scene/builtin/furniture.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"
#include "precompute/scene/builtin/wood.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

enum Picture : std::uint32_t { floorboards, parquet, wood };

// Built in this order by table_materials().
enum Substance : std::uint32_t {
    floor,
    inlay,
    oak,
    cloth,
    terracotta,
    earth,
    stem,
    leaf_dark,
    leaf_mid,
    leaf_light,
    glaze,
    copper,
    orange,
    lemon,
    apple
};

Material glossy(const char* name,
                const Imath::V3f& colour,
                float roughness,
                float metallic = 0) {
    return {.name = name,
            .model = BsdfModel::ggx,
            .base_colour = colour,
            .metallic = metallic,
            .roughness = roughness};
}

std::vector<Material> table_materials() {
    std::vector<Material> materials;
    materials.push_back(
        {.name = "floor", .base_colour = {0.95F, 0.93F, 0.9F}, .base_texture = floorboards});
    materials.push_back(glossy("inlay", {1, 1, 1}, 0.36F));
    materials.back().base_texture = parquet;
    materials.push_back({.name = "oak", .base_colour = {1, 1, 1}, .base_texture = wood});
    materials.push_back({.name = "cloth", .base_colour = {0.07F, 0.16F, 0.24F}});
    materials.push_back({.name = "terracotta", .base_colour = {0.58F, 0.24F, 0.13F}});
    materials.push_back({.name = "earth", .base_colour = {0.06F, 0.04F, 0.028F}});
    materials.push_back({.name = "stem", .base_colour = {0.17F, 0.24F, 0.07F}});
    materials.push_back(glossy("leaf, dark", {0.055F, 0.17F, 0.035F}, 0.5F));
    materials.push_back(glossy("leaf, mid", {0.10F, 0.26F, 0.05F}, 0.5F));
    materials.push_back(glossy("leaf, light", {0.20F, 0.37F, 0.075F}, 0.5F));
    materials.push_back(glossy("glaze", {0.03F, 0.17F, 0.22F}, 0.22F));
    materials.push_back(glossy("copper", {0.93F, 0.60F, 0.48F}, 0.32F, 1));
    materials.push_back(glossy("orange", {0.80F, 0.28F, 0.02F}, 0.42F));
    materials.push_back(glossy("lemon", {0.83F, 0.62F, 0.06F}, 0.4F));
    materials.push_back(glossy("apple", {0.42F, 0.05F, 0.03F}, 0.28F));
    return materials;
}

Mesh floor_mesh() {
    constexpr int kTiles = 4;  // each way from the middle
    constexpr float kTile = 1.7F;
    MeshBuilder builder("floor", floor);
    for (int i = -kTiles; i < kTiles; ++i) {
        for (int j = -kTiles; j < kTiles; ++j) {
            const float x = kTile * static_cast<float>(i);
            const float z = kTile * static_cast<float>(j);
            builder.add_quad({x, 0, z + kTile}, {x + kTile, 0, z + kTile}, {x + kTile, 0, z},
                             {x, 0, z});
        }
    }
    return builder.take();
}

Mesh inlay_mesh() {
    // A hair below the frame, so that the frame's inner edge shows.
    constexpr float kY = kTableHeight - 0.0015F;
    constexpr float kH = kInlayWidth / 2;
    MeshBuilder builder("inlay", inlay);
    builder.add_quad({-kH, kY, kH}, {kH, kY, kH}, {kH, kY, -kH}, {-kH, kY, -kH});
    return builder.take();
}

void add_seats(Scene& scene) {
    MeshBuilder wooden("table and chairs", oak);
    MeshBuilder cushions("cushions", cloth);
    add_table(wooden);
    // Pulled out by different amounts, as people leave them.
    const std::vector<Imath::M44f> places{
        placed({0.05F, 0, 0.66F}, 6), placed({0.86F, 0, 0.10F}, 74),
        placed({-0.03F, 0, -0.74F}, 176), placed({-0.70F, 0, -0.05F}, -86)};
    for (const Imath::M44f& place : places) {
        wooden.place(place);
        add_chair(wooden);
        cushions.place(place);
        add_cushion(cushions);
    }
    scene.meshes.push_back(wooden.take());
    scene.meshes.push_back(cushions.take());
}

void add_potted_plant(Scene& scene) {
    const Imath::M44f place = placed({-0.2F, kTableHeight - 0.0015F, -0.16F}, 0);
    MeshBuilder pot("pot", terracotta);
    MeshBuilder soil("soil", earth);
    MeshBuilder stems("stems", stem);
    std::vector<MeshBuilder> leaves;
    for (const std::uint32_t shade : {leaf_dark, leaf_mid, leaf_light})
        leaves.emplace_back("leaves", shade);
    for (MeshBuilder* part : {&pot, &soil, &stems, &leaves[0], &leaves[1], &leaves[2]})
        part->place(place);
    add_pot(pot);
    add_soil(soil);
    add_plant({stems, {&leaves[0], &leaves[1], &leaves[2]}}, 2026);
    for (MeshBuilder* part : {&pot, &soil, &stems, &leaves[0], &leaves[1], &leaves[2]})
        scene.meshes.push_back(part->take());
}

void add_crockery(Scene& scene) {
    constexpr float kY = kTableHeight - 0.0015F;
    MeshBuilder vase("vase", glaze);
    vase.place(placed({0.26F, kY, -0.3F}, 0));
    add_vase(vase);
    scene.meshes.push_back(vase.take());

    const Imath::M44f bowl_place = placed({0.2F, kY, 0.17F}, 0);
    MeshBuilder bowl("bowl", copper);
    bowl.place(bowl_place);
    add_bowl(bowl);
    scene.meshes.push_back(bowl.take());

    const auto add_fruit = [&](Substance substance, const Imath::V3f& centre, float radius) {
        MeshBuilder fruit("fruit", substance);
        fruit.place(bowl_place);
        fruit.add_sphere(centre, radius, 48);
        scene.meshes.push_back(fruit.take());
    };
    add_fruit(orange, {-0.058F, 0.066F, 0.03F}, 0.043F);
    add_fruit(orange, {0.012F, 0.064F, -0.062F}, 0.041F);
    add_fruit(apple, {0.06F, 0.063F, 0.03F}, 0.04F);
    add_fruit(lemon, {0.0F, 0.122F, 0.004F}, 0.034F);
}

}  // namespace

Scene build_table() {
    Scene scene;
    scene.name = "table";
    scene.textures.push_back(floorboard_texture(1024, 10));
    scene.textures.push_back(parquet_texture(1024, 8));
    scene.textures.push_back(wood_texture(1024));
    scene.materials = table_materials();
    scene.meshes.push_back(floor_mesh());
    scene.meshes.push_back(inlay_mesh());
    add_seats(scene);
    add_potted_plant(scene);
    add_crockery(scene);
    scene.camera = {.name = "standing",
                    .eye = {1.75F, 1.85F, 2.35F},
                    .look_at = {0.06F, 0.53F, 0.04F},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 37.5F};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
