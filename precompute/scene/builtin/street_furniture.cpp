#include "precompute/scene/builtin/street_furniture.h"

#include "precompute/scene/builtin/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Of a lamp post: where the arm begins to bend, and the arc of its axis.
constexpr float kPostHeight = 3.5F;
constexpr float kArmRadius = 0.62F;
constexpr float kArmEnd = 0.94F * kPi;  // radians along the arc

Imath::V3f arm_point(float angle) {
    return {0, kPostHeight + kArmRadius * std::sin(angle),
            kArmRadius * (1.0F - std::cos(angle))};
}

}  // namespace

void add_lamp_post(MeshBuilder& paint) {
    // A foot with two mouldings, then a slender shaft.
    std::vector<TubePoint> axis{
        {{0, 0, 0}, 0.135F},     {{0, 0.05F, 0}, 0.135F}, {{0, 0.075F, 0}, 0.115F},
        {{0, 0.12F, 0}, 0.098F}, {{0, 0.52F, 0}, 0.088F}, {{0, 0.56F, 0}, 0.112F},
        {{0, 0.60F, 0}, 0.116F}, {{0, 0.64F, 0}, 0.112F}, {{0, 0.69F, 0}, 0.072F},
        {{0, 0.76F, 0}, 0.062F}, {{0, 1.7F, 0}, 0.053F},  {{0, 2.62F, 0}, 0.046F},
        {{0, 2.66F, 0}, 0.064F}, {{0, 2.69F, 0}, 0.068F}, {{0, 2.72F, 0}, 0.064F},
        {{0, 2.77F, 0}, 0.044F}, {{0, 3.15F, 0}, 0.040F},
    };
    constexpr int kSteps = 18;
    for (int i = 0; i <= kSteps; ++i) {
        const float part = static_cast<float>(i) / kSteps;
        axis.push_back({arm_point(kArmEnd * part), 0.038F - 0.012F * part});
    }
    paint.add_tube(axis, 16, Closing::closed);
}

void add_lamp_shade(MeshBuilder& paint) {
    const Imath::V3f end = arm_point(kArmEnd);
    const auto at = [&](float radius, float below) {
        return ProfilePoint{radius, end.y - below};
    };
    // A bell: its hollow first, then the outside up to the socket around the arm's end.
    std::vector<ProfilePoint> outline{
        at(0, 0.115F),      at(0.12F, 0.125F),  at(0.205F, 0.165F), at(0.262F, 0.236F),
        at(0.270F, 0.250F), at(0.279F, 0.248F), at(0.281F, 0.234F), at(0.262F, 0.18F),
        at(0.205F, 0.115F), at(0.125F, 0.066F), at(0.066F, 0.038F), at(0.052F, 0.01F),
        at(0.046F, -0.05F), at(0.03F, -0.07F),  at(0, -0.072F)};
    // The builder turns outlines around the axis through its own origin.
    MeshBuilder bell("bell", 0);
    bell.add_lathe(outline, 28);
    paint.add_mesh(bell.take(), {0, 0, end.z});
}

void add_lamp_globe(MeshBuilder& glass) {
    const Imath::V3f end = arm_point(kArmEnd);
    glass.add_sphere({0, end.y - 0.22F, end.z}, 0.105F, 16);
}

void add_bench_slats(MeshBuilder& wood) {
    constexpr float kLength = 1.7F;
    for (int i = 0; i < 5; ++i) {
        const float z = 0.19F - 0.095F * static_cast<float>(i);
        wood.add_box({0, 0.445F - 0.006F * static_cast<float>(i), z}, {kLength, 0.032F, 0.08F});
    }
    for (int i = 0; i < 4; ++i) {
        const float up = static_cast<float>(i);
        wood.add_box({0, 0.545F + 0.1F * up, -0.235F - 0.028F * up}, {kLength, 0.08F, 0.028F});
    }
}

void add_bench_frame(MeshBuilder& iron) {
    const auto tube = [&](const std::vector<Imath::V3f>& points, float radius) {
        std::vector<TubePoint> axis;
        axis.reserve(points.size());
        for (const Imath::V3f& point : points)
            axis.push_back({point, radius});
        iron.add_tube(axis, 8, Closing::closed);
    };
    for (const float x : {-0.72F, 0.72F}) {
        tube({{x, 0, 0.26F},
              {x, 0.12F, 0.235F},
              {x, 0.3F, 0.215F},
              {x, 0.42F, 0.22F},
              {x, 0.56F, 0.245F},
              {x, 0.62F, 0.235F},
              {x, 0.645F, 0.19F},
              {x, 0.65F, 0.08F},
              {x, 0.64F, -0.1F},
              {x, 0.63F, -0.24F}},
             0.018F);
        tube({{x, 0, -0.36F},
              {x, 0.15F, -0.3F},
              {x, 0.32F, -0.255F},
              {x, 0.43F, -0.24F},
              {x, 0.6F, -0.272F},
              {x, 0.78F, -0.325F},
              {x, 0.9F, -0.365F}},
             0.018F);
        tube({{x, 0.4F, 0.21F}, {x, 0.405F, 0}, {x, 0.4F, -0.235F}}, 0.016F);
    }
}

void add_bollard(MeshBuilder& paint) {
    paint.add_lathe({{0, 0},          {0.098F, 0},      {0.1F, 0.01F},    {0.1F, 0.055F},
                     {0.09F, 0.075F}, {0.072F, 0.1F},   {0.066F, 0.14F},  {0.06F, 0.66F},
                     {0.062F, 0.69F}, {0.078F, 0.705F}, {0.081F, 0.72F},  {0.078F, 0.735F},
                     {0.06F, 0.75F},  {0.05F, 0.765F},  {0.066F, 0.79F},  {0.076F, 0.82F},
                     {0.076F, 0.85F}, {0.064F, 0.885F}, {0.042F, 0.905F}, {0.018F, 0.915F},
                     {0, 0.917F}},
                    16);
}

void add_pillar_box(MeshBuilder& lacquer) {
    lacquer.add_lathe({{0, 0.13F},
                       {0.205F, 0.13F},
                       {0.21F, 0.14F},
                       {0.21F, 0.16F},
                       {0.2F, 0.175F},
                       {0.2F, 0.6F},
                       {0.2F, 1.02F},
                       {0.203F, 1.2F},
                       {0.215F, 1.215F},
                       {0.245F, 1.225F},
                       {0.252F, 1.24F},
                       {0.252F, 1.275F},
                       {0.245F, 1.29F},
                       {0.225F, 1.3F},
                       {0.215F, 1.325F},
                       {0.18F, 1.365F},
                       {0.125F, 1.395F},
                       {0.06F, 1.412F},
                       {0, 1.417F}},
                      36);
}

void add_pillar_box_foot(MeshBuilder& paint) {
    paint.add_lathe(
        {{0, 0}, {0.222F, 0}, {0.226F, 0.008F}, {0.226F, 0.105F}, {0.215F, 0.13F}, {0, 0.13F}},
        48);
    // The slot for letters, and the frame of the hours of collection.
    paint.add_box({0, 1.08F, 0.197F}, {0.19F, 0.028F, 0.02F});
    paint.add_box({0, 0.86F, 0.197F}, {0.11F, 0.15F, 0.014F});
}

void add_trunk(MeshBuilder& bark, std::uint32_t seed) {
    std::vector<TubePoint> axis;
    constexpr int kRows = 12;
    for (int i = 0; i <= kRows; ++i) {
        const float part = static_cast<float>(i) / kRows;
        const float y = 2.3F * part;
        const float bend = 0.07F * part;
        axis.push_back({{bend * value_noise({0.5F, 1.3F * y, 0.5F}, seed), y,
                         bend * value_noise({0.5F, 1.3F * y, 4.5F}, seed)},
                        0.075F + 0.06F * std::exp(-9.0F * part) - 0.015F * part});
    }
    bark.add_tube(axis, 12, Closing::closed);
}

// One closed surface: as far from the middle as the farthest of a few balls reaches.
void add_crown(MeshBuilder& leaves, std::uint32_t seed) {
    constexpr std::uint32_t kSegments = 44;
    constexpr std::uint32_t kRows = kSegments / 2 + 1;
    constexpr Imath::V3f kMiddle(0, 2.75F, 0);
    struct Ball {
        Imath::V3f centre;  // from the middle
        float radius;
    };
    constexpr Ball kBalls[]{{{0.02F, 0, 0.05F}, 0.82F},
                            {{-0.55F, -0.3F, 0.18F}, 0.5F},
                            {{0.52F, -0.23F, -0.12F}, 0.52F},
                            {{0.1F, -0.15F, 0.6F}, 0.45F},
                            {{0.08F, 0.6F, -0.04F}, 0.55F}};
    const auto reach = [&](const Imath::V3f& out) {
        float farthest = 0;
        for (const auto& [centre, radius] : kBalls) {
            const float along = out.dot(centre);
            const float inside = radius * radius - centre.length2() + along * along;
            if (inside > 0)
                farthest = std::max(farthest, along + std::sqrt(inside));
        }
        return farthest;
    };
    leaves.add_grid(kRows, kSegments, Closing::open, Closing::closed,
                    [&](std::uint32_t i, std::uint32_t j) {
                        const float theta = kPi * static_cast<float>(i) / (kRows - 1);
                        const float phi = 2 * kPi * static_cast<float>(j) / kSegments;
                        const float ring = i == 0 || i + 1 == kRows ? 0.0F : std::sin(theta);
                        const Imath::V3f out(ring * std::cos(phi), -std::cos(theta),
                                             -ring * std::sin(phi));
                        const float bumps = 0.5F * value_noise(out * 2.6F, seed) +
                                            0.5F * fractal_noise(out * 6.5F, 2, 0.6F, seed + 3);
                        return kMiddle + out * (reach(out) * (1.0F + 0.16F * bumps));
                    });
}

}  // namespace relume::scene
