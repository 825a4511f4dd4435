#include "precompute/scene/builtin/drape.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "precompute/scene/builtin/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {
namespace {

enum Substance : std::uint32_t { pearl, post, cloth, wood };

constexpr float kPearlRadius = 0.0075F;
// A round pedestal with a rounded rim.
constexpr float kPedestalHeight = 0.16F;
constexpr float kPedestalRadius = 0.052F;
constexpr float kRim = 0.010F;
constexpr float kUnderCloth = 0.001F;  // how far below the cloth the pedestal's surface lies

// A fold that the cloth is gathered into: a ridge from the middle of the pedestal outwards and
// down its side.
struct Fold {
    float azimuth_degrees = 0;  // at the rim, from +X to +Z
    float turn = 0;             // radians more, from the rim to the middle
    float height = 0;
    float width = 0;
    float begins = 0;  // distance from the middle
};

constexpr std::array<Fold, 15> kFolds{{{2, 0.5F, 0.0077F, 0.0041F, 0.023F},
                                       {30, -0.9F, 0.0064F, 0.0041F, 0.022F},
                                       {53, -0.8F, 0.0064F, 0.0030F, 0.021F},
                                       {73, -1.0F, 0.0054F, 0.0030F, 0.025F},
                                       {100, -0.7F, 0.0077F, 0.0028F, 0.021F},
                                       {115, -1.0F, 0.0080F, 0.0029F, 0.017F},
                                       {150, 0.7F, 0.0057F, 0.0041F, 0.020F},
                                       {170, -0.6F, 0.0083F, 0.0037F, 0.026F},
                                       {197, -0.4F, 0.0059F, 0.0029F, 0.016F},
                                       {210, -0.4F, 0.0069F, 0.0026F, 0.022F},
                                       {238, -0.4F, 0.0078F, 0.0034F, 0.018F},
                                       {264, 0.4F, 0.0047F, 0.0042F, 0.014F},
                                       {291, 0.7F, 0.0046F, 0.0039F, 0.018F},
                                       {313, -1.0F, 0.0047F, 0.0029F, 0.025F},
                                       {332, 0.5F, 0.0082F, 0.0041F, 0.018F}}};

// How far the cloth stands off the pedestal at the point's azimuth and distance from the axis.
float fold_height(float x, float z) {
    constexpr float kRadians = std::numbers::pi_v<float> / 180;
    constexpr float kFar = 3;
    constexpr float kRise = 0.016F;  // from where a fold begins to its full height
    const float radius = std::min(std::hypot(x, z), kPedestalRadius);
    const float azimuth = std::atan2(z, x);
    float height = 0;
    for (const Fold& fold : kFolds) {
        const float along = std::clamp((radius - fold.begins) / kRise, 0.0F, 1.0F);
        const float middle =
            fold.azimuth_degrees * kRadians + fold.turn * (1 - radius / kPedestalRadius);
        const float aside = radius *
                            std::remainder(azimuth - middle, 2 * std::numbers::pi_v<float>) /
                            fold.width;
        if (along > 0 && std::abs(aside) < kFar)
            height += fold.height * along * along * (3 - 2 * along) * std::exp(-aside * aside);
    }
    return height;
}

// Out of the pedestal and its folds, and off the floor.
Imath::V3f out_of_pedestal(const Imath::V3f& point) {
    Imath::V3f out(point.x, std::max(point.y, kUnderCloth), point.z);
    const float radius = std::hypot(out.x, out.z);
    const float beyond = radius - (kPedestalRadius - kRim);
    const float above = out.y - (kPedestalHeight - kRim);
    const float distance = std::hypot(std::max(beyond, 0.0F), std::max(above, 0.0F)) +
                           std::min(std::max(beyond, above), 0.0F) - kRim;
    constexpr float kHighest = 0.012F;  // of folds, also where they meet
    const float depth = distance < kHighest ? fold_height(out.x, out.z) - distance : -distance;
    if (depth <= 0)
        return out;
    Imath::V2f normal = above >= beyond ? Imath::V2f(0, 1) : Imath::V2f(1, 0);
    if (beyond > 0 && above > 0)
        normal = Imath::V2f(beyond, above).normalized();
    const float outwards = radius > 0 ? normal.x * depth / radius : 0.0F;
    return {out.x * (1 + outwards), out.y + normal.y * depth, out.z * (1 + outwards)};
}

Cloth fallen_cloth() {
    constexpr ClothDrop kDrop{.side = 0.24F,
                              .height = kPedestalHeight + 0.004F,
                              .slack = 0.13F,
                              .count = 81,
                              .steps = 200,
                              .iterations = 10,
                              .seed = 7};
    constexpr std::uint32_t kPoints = 103;  // 20,808 triangles
    return smoothed_cloth(draped_cloth(kDrop, out_of_pedestal), kPoints);
}

Mesh mesh_of(const Cloth& fallen) {
    MeshBuilder builder("cloth", cloth);
    builder.add_grid(
        fallen.count, fallen.count, Closing::open, Closing::open,
        [&](std::uint32_t i, std::uint32_t j) { return fallen.at(fallen.count - 1 - i, j); });
    return builder.take();
}

// The height of the middle of a ball that lies on the cloth at (x, z), having sunk in a little.
float height_of_ball(const Cloth& fallen, float x, float z) {
    constexpr float kSunk = 0.0003F;
    float height = 0;
    for (const Imath::V3f& point : fallen.points) {
        const float distance = std::hypot(point.x - x, point.z - z);
        if (distance < kPearlRadius) {
            const float rise = std::sqrt(kPearlRadius * kPearlRadius - distance * distance);
            height = std::max(height, point.y + rise);
        }
    }
    return height - kSunk;
}

// A cup that holds the pearl, and a pin with a notch for the clasp; the pearl's middle is the
// origin, the pin points along +Y.
void add_post(MeshBuilder& builder) {
    builder.add_lathe(
        {{0.00290F, 0.00690F}, {0.00335F, 0.00672F}, {0.00345F, 0.00685F}, {0.00340F, 0.00715F},
         {0.00325F, 0.00735F}, {0.00270F, 0.00775F}, {0.00190F, 0.00815F}, {0.00120F, 0.00842F},
         {0.00085F, 0.00870F}, {0.00068F, 0.00905F}, {0.00060F, 0.00950F}, {0.00060F, 0.01000F},
         {0.00060F, 0.01400F}, {0.00060F, 0.01790F}, {0.00058F, 0.01800F}, {0.00044F, 0.01815F},
         {0.00042F, 0.01830F}, {0.00042F, 0.01860F}, {0.00044F, 0.01875F}, {0.00058F, 0.01890F},
         {0.00060F, 0.01900F}, {0.00060F, 0.02010F}, {0.00056F, 0.02035F}, {0.00044F, 0.02055F},
         {0.00024F, 0.02066F}, {0, 0.02070F}},
        48);
}

struct Earring {
    float x = 0;
    float z = 0;
    float lean_degrees = 0;  // of the pin, from upright
    float turn_degrees = 0;  // of where it leans to, around +Y from +X to −Z
};

void add_earring(const Earring& earring,
                 const Cloth& fallen,
                 MeshBuilder& pearls,
                 MeshBuilder& posts) {
    constexpr float kRadians = std::numbers::pi_v<float> / 180;
    const Imath::V3f centre(earring.x, height_of_ball(fallen, earring.x, earring.z), earring.z);
    pearls.add_sphere(centre, kPearlRadius, 96);
    Imath::M44f lean;
    lean.setEulerAngles(Imath::V3f(0, 0, -earring.lean_degrees * kRadians));
    posts.place(lean * placed(centre, earring.turn_degrees));
    add_post(posts);
}

Mesh pedestal() {
    constexpr int kSteps = 12;
    MeshBuilder builder("pedestal", wood);
    const float radius = kPedestalRadius - kUnderCloth;
    const float height = kPedestalHeight - kUnderCloth;
    std::vector<ProfilePoint> outline{{0, 0}, {radius, 0}};
    for (int i = 0; i <= kSteps; ++i) {
        const float angle =
            std::numbers::pi_v<float> / 2 * static_cast<float>(i) / static_cast<float>(kSteps);
        outline.push_back(
            {radius - kRim + kRim * std::cos(angle), height - kRim + kRim * std::sin(angle)});
    }
    outline.push_back({0, height});
    builder.add_lathe(outline, 64);
    return builder.take();
}

}  // namespace

Scene build_earrings() {
    Scene scene;
    scene.name = "earrings";
    scene.materials.push_back({.name = "pearl",
                               .model = BsdfModel::ggx,
                               .base_colour = {0.72F, 0.66F, 0.60F},
                               .metallic = 0,
                               .roughness = 0.36F,
                               .dielectric_f0 = {0.06F, 0.06F, 0.06F}});
    scene.materials.push_back({.name = "post",
                               .model = BsdfModel::ggx,
                               .base_colour = {0.93F, 0.91F, 0.88F},
                               .metallic = 1,
                               .roughness = 0.32F});
    scene.materials.push_back({.name = "cloth",
                               .model = BsdfModel::ggx,
                               .base_colour = {0.36F, 0.025F, 0.04F},
                               .metallic = 0,
                               .roughness = 0.7F});
    scene.materials.push_back({.name = "pedestal", .base_colour = {0.3F, 0.2F, 0.12F}});
    const Cloth fallen = fallen_cloth();
    MeshBuilder pearls("pearls", pearl);
    MeshBuilder posts("posts", post);
    add_earring({.x = -0.0125F, .z = 0.010F, .lean_degrees = 62, .turn_degrees = 150}, fallen,
                pearls, posts);
    add_earring({.x = 0.0115F, .z = -0.004F, .lean_degrees = 48, .turn_degrees = 20}, fallen,
                pearls, posts);
    scene.meshes.push_back(mesh_of(fallen));
    scene.meshes.push_back(pearls.take());
    scene.meshes.push_back(posts.take());
    scene.meshes.push_back(pedestal());
    scene.camera = {.name = "close",
                    .eye = {0.012F, 0.228F, 0.150F},
                    .look_at = {0, 0.161F, 0.004F},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 23};
    finish_scene(scene);
    return scene;
}

}  // namespace relume::scene
