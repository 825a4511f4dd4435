#include "precompute/scene/builtin/wood.h"

#include "precompute/scene/builtin/noise.h"
#include "precompute/scene/builtin/painting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::scene {
namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

struct Tones {
    Imath::V3f early;  // the wide pale part of a year ring
    Imath::V3f late;
};

constexpr Tones kOak{{0.53F, 0.33F, 0.165F}, {0.33F, 0.175F, 0.075F}};
constexpr Tones kMaple{{0.64F, 0.46F, 0.27F}, {0.50F, 0.32F, 0.165F}};
constexpr Tones kWalnut{{0.27F, 0.145F, 0.078F}, {0.145F, 0.070F, 0.036F}};
constexpr Tones kAsh{{0.50F, 0.42F, 0.33F}, {0.38F, 0.30F, 0.22F}};

// Colour of a board at (along, across) in board lengths and widths. `along` is put on a circle,
// so that it repeats with period 1.
Imath::V3f grain(float along, float across, const Tones& tones, std::uint32_t seed) {
    const float angle = kTwoPi * along;
    const Imath::V3f slow(std::cos(angle) * 0.35F, across * 2.2F, std::sin(angle) * 0.35F);
    const float bend = fractal_noise(slow, 3, 0.5F, seed) * 0.55F;
    const float ring = across * 9.0F + bend * 4.0F;
    const float phase = ring - std::floor(ring);
    const float late = phase * phase * (1.0F - std::max(0.0F, phase - 0.92F) / 0.08F);
    const Imath::V3f fast(std::cos(angle) * 9.0F, across * 130.0F, std::sin(angle) * 9.0F);
    const float fibre = 1.0F + 0.16F * fractal_noise(fast, 2, 0.6F, seed + 17);
    return (tones.early + (tones.late - tones.early) * std::clamp(late, 0.0F, 1.0F)) * fibre;
}

}  // namespace

Texture wood_texture(std::uint32_t side) {
    return painted("wood", side, [](float u, float v) { return grain(u, v, kOak, 3); });
}

Texture parquet_texture(std::uint32_t side, std::uint32_t squares) {
    return painted("parquet", side, [squares](float u, float v) {
        const float x = u * static_cast<float>(squares);
        const float y = v * static_cast<float>(squares);
        const auto column = static_cast<std::uint32_t>(x);
        const auto row = static_cast<std::uint32_t>(y);
        const float fx = x - std::floor(x);
        const float fy = y - std::floor(y);
        const bool is_dark = (row + column) % 2 == 1;
        const std::uint32_t seed = 101 + 31 * (row * squares + column);
        const Imath::V3f wood = is_dark ? grain(fy * 0.3F, fx * 0.7F, kWalnut, seed)
                                        : grain(fx * 0.3F, fy * 0.7F, kMaple, seed);
        return wood * (0.35F + 0.65F * inside(fx, 0.02F) * inside(fy, 0.02F));
    });
}

Texture floorboard_texture(std::uint32_t side, std::uint32_t boards) {
    return painted("floorboards", side, [boards](float u, float v) {
        const float y = v * static_cast<float>(boards);
        const auto board = static_cast<std::uint32_t>(y);
        const float fy = y - std::floor(y);
        // Boards are staggered by a golden-ratio step, so that no two joints line up.
        const float start = static_cast<float>(board) * 0.618034F;
        const float x = u * 2.0F + start;
        const auto piece = static_cast<std::uint32_t>(x) % 2 + 2 * board;
        const float fx = x - std::floor(x);
        const float tone =
            0.86F + 0.14F * value_noise({0.5F, 0.5F, 7.3F * static_cast<float>(piece)}, 5);
        const Imath::V3f wood = grain(fx * 0.5F, fy * 0.5F, kAsh, 907 + 13 * piece) * tone;
        return wood * (0.45F + 0.55F * inside(fy, 0.03F) * inside(fx, 0.006F));
    });
}

}  // namespace relume::scene
