#include "precompute/scene/builtin/masonry.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"
#include "precompute/scene/builtin/street_furniture.h"
#include "precompute/scene/builtin/wood.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace relume::scene {
namespace {

enum Picture : std::uint32_t { flagstones, asphalt, bricks, wood };

// Built in this order by street_materials().
enum Substance : std::uint32_t {
    road,
    pavement,
    granite,
    brickwork,
    coping,
    paint,
    glass,
    slats,
    lacquer,
    bark,
    leaves,
    leaves_light
};

constexpr float kPavement = 0.14F;  // above the road
constexpr float kHalfLength = 9.0F;

Material textured(const char* name, Picture picture) {
    return {.name = name, .base_colour = {1, 1, 1}, .base_texture = picture};
}

std::vector<Material> street_materials() {
    std::vector<Material> materials;
    materials.push_back(textured("road", asphalt));
    materials.push_back(textured("pavement", flagstones));
    materials.push_back(textured("granite", flagstones));
    materials.back().base_colour = {1.25F, 1.3F, 1.36F};
    materials.push_back(textured("brickwork", bricks));
    materials.push_back({.name = "coping", .base_colour = {0.55F, 0.52F, 0.46F}});
    materials.push_back({.name = "paint",
                         .model = BsdfModel::phong,
                         .base_colour = {0.022F, 0.060F, 0.046F},
                         .specular = {0.32F, 0.32F, 0.32F},
                         .exponent = 160});
    materials.push_back({.name = "glass",
                         .model = BsdfModel::phong,
                         .base_colour = {0.70F, 0.62F, 0.46F},
                         .specular = {0.25F, 0.25F, 0.25F},
                         .exponent = 80});
    materials.push_back(textured("slats", wood));
    materials.push_back({.name = "lacquer",
                         .model = BsdfModel::ggx,
                         .base_colour = {0.58F, 0.022F, 0.018F},
                         .metallic = 0,
                         .roughness = 0.28F});
    materials.push_back({.name = "bark", .base_colour = {0.19F, 0.135F, 0.09F}});
    materials.push_back({.name = "leaves", .base_colour = {0.10F, 0.21F, 0.045F}});
    materials.push_back({.name = "leaves, light", .base_colour = {0.19F, 0.28F, 0.06F}});
    return materials;
}

// Metres of a box's texture coordinates to repeats of its picture.
Mesh with_picture_size(Mesh mesh, float metres) {
    for (Imath::V2f& uv : mesh.uvs)
        uv /= metres;
    return mesh;
}

// Slabs with a top, a bottom and sides. Where two touch, whole sides do, so that no side is
// half in the dark.
void add_ground(Scene& scene) {
    constexpr float kBottom = -0.4F;
    constexpr float kKerb = 0.16F;
    constexpr float kRoad = 6.5F;
    constexpr float kWalk = 5.2F;
    struct Span {
        float from, to;
    };
    const auto add_slab = [&](const char* name, Substance substance, Span y, Span z,
                              float picture_size) {
        MeshBuilder slab(name, substance);
        slab.add_box({0, (y.from + y.to) / 2, (z.from + z.to) / 2},
                     {2 * kHalfLength, y.to - y.from, z.to - z.from});
        scene.meshes.push_back(with_picture_size(slab.take(), picture_size));
    };
    add_slab("road", road, {kBottom, 0}, {kKerb, kKerb + kRoad}, 3);
    add_slab("foundation", granite, {kBottom, 0}, {-kWalk, kKerb}, 4.8F);
    add_slab("kerb", granite, {0, kPavement}, {0, kKerb}, 4.8F);
    add_slab("pavement", pavement, {0, kPavement}, {-kWalk, 0}, 2.4F);
}

// Two lengths of wall between pillars with balls on them; the gap is a gateway.
void add_wall(Scene& scene) {
    constexpr float kZ = -4.75F;
    constexpr float kHeight = 1.25F;
    constexpr float kThick = 0.26F;
    struct Length {
        float from, to;
    };
    MeshBuilder wall("wall", brickwork);
    MeshBuilder pillars("pillars", brickwork);
    MeshBuilder top("coping", coping);
    for (const auto& [from, to] : {Length{-8.6F, 1.07F}, Length{3.53F, 8.6F}}) {
        const float middle = (from + to) / 2;
        const float length = to - from;
        wall.add_box({middle, kPavement + kHeight / 2, kZ}, {length, kHeight, kThick});
        top.add_tapered_bar({middle, kPavement + kHeight, kZ}, {length, kThick},
                            {middle, kPavement + kHeight + 0.075F, kZ},
                            {length, kThick + 0.12F});
    }
    for (const float x : {1.3F, 3.3F}) {
        constexpr float kPillar = 1.75F;
        pillars.add_box({x, kPavement + kPillar / 2, kZ}, {0.46F, kPillar, 0.46F});
        top.add_tapered_bar({x, kPavement + kPillar, kZ}, {0.46F, 0.46F},
                            {x, kPavement + kPillar + 0.1F, kZ}, {0.6F, 0.6F});
        top.add_sphere({x, kPavement + kPillar + 0.285F, kZ}, 0.19F, 24);
    }
    scene.meshes.push_back(with_picture_size(wall.take(), 1));
    scene.meshes.push_back(with_picture_size(pillars.take(), 1));
    for (Imath::V2f& uv : scene.meshes.back().uvs)
        std::swap(uv.x, uv.y);  // courses lie across what is tall
    scene.meshes.push_back(top.take());
}

void add_lamps(Scene& scene) {
    MeshBuilder posts("lamp posts", paint);
    MeshBuilder globes("globes", glass);
    for (const float x : {-4.6F, 0.15F, 4.9F}) {
        const Imath::M44f place = placed({x, kPavement, -0.42F}, 0);
        posts.place(place);
        globes.place(place);
        add_lamp_post(posts);
        add_lamp_shade(posts);
        add_lamp_globe(globes);
    }
    scene.meshes.push_back(posts.take());
    scene.meshes.push_back(globes.take());
}

void add_small_things(Scene& scene) {
    MeshBuilder painted("bollards and iron", paint);
    MeshBuilder wooden("bench", slats);
    MeshBuilder red("pillar box", lacquer);
    for (const float x : {-2.9F, -1.55F, 1.75F, 3.1F}) {
        painted.place(placed({x, kPavement, -0.36F}, 0));
        add_bollard(painted);
    }
    const Imath::M44f bench = placed({-1.25F, kPavement, -2.35F}, 8);
    wooden.place(bench);
    painted.place(bench);
    add_bench_slats(wooden);
    add_bench_frame(painted);
    const Imath::M44f box = placed({1.3F, kPavement, -1.5F}, -12);
    red.place(box);
    painted.place(box);
    add_pillar_box(red);
    add_pillar_box_foot(painted);
    scene.meshes.push_back(painted.take());
    scene.meshes.push_back(with_picture_size(wooden.take(), 1.7F));
    scene.meshes.push_back(red.take());
}

void add_trees(Scene& scene) {
    MeshBuilder trunks("trunks", bark);
    std::vector<MeshBuilder> crowns;
    crowns.emplace_back("crown", leaves);
    crowns.emplace_back("crown", leaves_light);
    const Imath::M44f places[]{placed({-3.3F, kPavement, -3.1F}, 20),
                               placed({5.3F, kPavement, -3.3F}, 130)};
    for (std::uint32_t i = 0; i < 2; ++i) {
        trunks.place(places[i]);
        crowns[i].place(places[i]);
        add_trunk(trunks, 11 + i);
        add_crown(crowns[i], 23 + 5 * i);
    }
    scene.meshes.push_back(trunks.take());
    for (MeshBuilder& crown : crowns)
        scene.meshes.push_back(crown.take());
}

}  // namespace

Scene build_street() {
    Scene scene;
    scene.name = "street";
    scene.textures.push_back(flagstone_texture(512, 4));
    scene.textures.push_back(asphalt_texture(512));
    scene.textures.push_back(brick_texture(512, 4, 12));
    scene.textures.push_back(wood_texture(512));
    scene.materials = street_materials();
    add_ground(scene);
    add_wall(scene);
    add_lamps(scene);
    add_small_things(scene);
    add_trees(scene);
    scene.camera = {.name = "from the road",
                    .eye = {-4.6F, 2.15F, 6.3F},
                    .look_at = {0.25F, 1.92F, -1.6F},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 44};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
