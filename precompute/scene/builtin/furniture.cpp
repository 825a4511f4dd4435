#include "precompute/scene/builtin/furniture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace relume::scene {
void add_table(MeshBuilder& wood) {
    constexpr float kThickness = 0.034F;
    constexpr float kFrame = (kTableWidth - kInlayWidth) / 2;
    constexpr float kMiddle = kTableHeight - kThickness / 2;
    constexpr float kBorder = (kTableWidth - kFrame) / 2;
    for (const float side : {-1.0F, 1.0F}) {
        wood.add_box({0, kMiddle, side * kBorder}, {kTableWidth, kThickness, kFrame});
        wood.add_box({side * kBorder, kMiddle, 0}, {kFrame, kThickness, kInlayWidth});
        // Aprons under the top.
        constexpr float kApron = kTableWidth / 2 - 0.1F;
        wood.add_box({0, kTableHeight - 0.085F, side * kApron}, {2 * kApron, 0.1F, 0.022F});
        wood.add_box({side * kApron, kTableHeight - 0.085F, 0}, {0.022F, 0.1F, 2 * kApron});
        for (const float other : {-1.0F, 1.0F}) {
            const float x = side * (kTableWidth / 2 - 0.1F);
            const float z = other * (kTableWidth / 2 - 0.1F);
            wood.add_tapered_bar({x * 1.05F, 0, z * 1.05F}, {0.034F, 0.034F},
                                 {x, kTableHeight - kThickness, z}, {0.068F, 0.068F});
        }
    }
    // The board below the inlay, seen from underneath.
    wood.add_box({0, kTableHeight - 0.02F, 0}, {kInlayWidth, 0.02F, kInlayWidth});
}

void add_chair(MeshBuilder& wood) {
    constexpr float kSeat = 0.45F;
    wood.add_box({0, kSeat - 0.014F, 0}, {0.44F, 0.028F, 0.42F});
    for (const float side : {-1.0F, 1.0F}) {
        const float x = 0.19F * side;
        wood.add_tapered_bar({x * 1.06F, 0, -0.19F}, {0.024F, 0.024F},
                             {x, kSeat - 0.028F, -0.18F}, {0.038F, 0.038F});
        wood.add_tapered_bar({x * 1.06F, 0, 0.245F}, {0.026F, 0.026F}, {x, kSeat, 0.195F},
                             {0.036F, 0.036F});
        wood.add_tapered_bar({x, kSeat, 0.195F}, {0.036F, 0.036F}, {x * 0.96F, 0.97F, 0.29F},
                             {0.024F, 0.024F});
        wood.add_box({x, 0.2F, 0.012F}, {0.018F, 0.026F, 0.4F});  // side stretchers
    }
    wood.add_box({0, 0.2F, -0.02F}, {0.38F, 0.026F, 0.018F});
    wood.add_box({0, kSeat - 0.055F, -0.18F}, {0.36F, 0.05F, 0.018F});
    // Back: two rails along the rake of the posts, slats between them.
    const auto rake = [](float y) { return 0.195F + (y - kSeat) * 0.095F / 0.52F; };
    wood.add_box({0, 0.56F, rake(0.56F)}, {0.36F, 0.04F, 0.02F});
    wood.add_box({0, 0.93F, rake(0.93F)}, {0.38F, 0.07F, 0.022F});
    for (int i = -3; i <= 3; ++i) {
        const float x = 0.048F * static_cast<float>(i);
        wood.add_tapered_bar({x, 0.575F, rake(0.575F)}, {0.02F, 0.01F},
                             {x * 1.04F, 0.9F, rake(0.9F)}, {0.02F, 0.01F});
    }
}

void add_cushion(MeshBuilder& cloth) {
    constexpr std::uint32_t kCells = 24;
    // A superellipsoid: |x|⁴ + |z|⁴ outline, softly domed.
    const auto height = [](float x, float z) {
        const float r =
            std::pow(std::pow(std::abs(x), 4.0F) + std::pow(std::abs(z), 4.0F), 0.25F);
        return 0.045F * std::sqrt(std::max(0.0F, 1.0F - r * r * r));
    };
    cloth.add_grid(kCells + 1, kCells + 1, Closing::open, Closing::open,
                   [&](std::uint32_t i, std::uint32_t j) {
                       const float z = 1.0F - 2.0F * static_cast<float>(i) / kCells;
                       const float x = 2.0F * static_cast<float>(j) / kCells - 1.0F;
                       // Square to rounded square.
                       const float sx = x * std::sqrt(std::sqrt(1.0F - 0.5F * z * z * z * z));
                       const float sz = z * std::sqrt(std::sqrt(1.0F - 0.5F * x * x * x * x));
                       return Imath::V3f(0.2F * sx, 0.451F + height(sx, sz),
                                         0.19F * sz - 0.005F);
                   });
}

void add_pot(MeshBuilder& clay) {
    clay.add_lathe({{0, 0},
                    {0.062F, 0},
                    {0.066F, 0.003F},
                    {0.088F, 0.118F},
                    {0.088F, 0.12F},
                    {0.097F, 0.121F},
                    {0.099F, 0.124F},
                    {0.101F, 0.152F},
                    {0.099F, 0.156F},
                    {0.092F, 0.156F},
                    {0.09F, 0.153F},
                    {0.088F, 0.125F}},
                   64);
}

void add_soil(MeshBuilder& soil) {
    soil.add_lathe({{0.0885F, 0.132F}, {0.06F, 0.137F}, {0, 0.14F}}, 48);
}

void add_vase(MeshBuilder& glaze) {
    std::vector<ProfilePoint> outline{{0, 0}, {0.034F, 0}, {0.037F, 0.002F}};
    constexpr std::uint32_t kSteps = 48;
    constexpr float kHeight = 0.27F;
    // Belly, neck and flared lip as one smooth curve, then back down inside.
    const auto radius = [](float t) {
        constexpr float kPi = std::numbers::pi_v<float>;
        const float belly =
            0.062F * std::pow(std::max(0.0F, std::sin(kPi * std::pow(t, 0.75F))), 1.2F);
        const float lip = 0.024F * std::pow(t, 7.0F);
        return 0.037F * (1.0F - t) + 0.017F * t + belly * (1.0F - 0.25F * t) + lip;
    };
    for (std::uint32_t i = 1; i <= kSteps; ++i) {
        const float t = static_cast<float>(i) / kSteps;
        outline.push_back({radius(t), 0.002F + kHeight * t});
    }
    const float lip = radius(1);
    outline.push_back({lip - 0.0015F, 0.002F + kHeight + 0.0015F});
    outline.push_back({lip - 0.004F, 0.002F + kHeight});
    for (std::uint32_t i = kSteps - 1; i > kSteps / 2; --i) {
        const float t = static_cast<float>(i) / kSteps;
        outline.push_back({radius(t) - 0.004F, 0.002F + kHeight * t});
    }
    glaze.add_lathe(outline, 96);
}

void add_bowl(MeshBuilder& metal) {
    constexpr std::uint32_t kSteps = 20;
    constexpr float kRadius = 0.17F;
    const auto point = [](std::uint32_t i, float inset) {
        const float t = static_cast<float>(i) / kSteps;
        const float angle = t * 1.25F;
        return ProfilePoint{0.03F * (t > 0 ? 1.0F : 0.0F) +
                                (kRadius - 0.03F - inset) * std::sin(angle) / 0.949F,
                            0.008F + inset + 0.095F * (1.0F - std::cos(angle)) / 0.6847F};
    };
    std::vector<ProfilePoint> outline{{0, 0}, {0.045F, 0}, {0.05F, 0.004F}};
    for (std::uint32_t i = 3; i <= kSteps; ++i)
        outline.push_back(point(i, 0));
    for (std::uint32_t i = kSteps; i >= 1; --i)
        outline.push_back(point(i, 0.004F));
    outline.push_back({0, 0.012F});
    metal.add_lathe(outline, 96);
}

}  // namespace relume::scene
