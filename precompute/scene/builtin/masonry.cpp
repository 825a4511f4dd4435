#include "precompute/scene/builtin/masonry.h"

#include "precompute/scene/builtin/noise.h"
#include "precompute/scene/builtin/painting.h"

#include <cmath>
#include <numbers>

namespace relume::scene {
namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

// Noise over a square that repeats: the square is wound around two circles.
float repeating_noise(
    float u, float v, float scale, std::uint32_t octaves, std::uint32_t seed) {
    const float a = kTwoPi * u;
    const float b = kTwoPi * v;
    const Imath::V3f first(std::cos(a) * scale, std::sin(a) * scale, std::cos(b) * scale);
    const Imath::V3f second(std::sin(b) * scale, std::cos(a) * scale, std::sin(a) * scale);
    return 0.5F * (fractal_noise(first, octaves, 0.6F, seed) +
                   fractal_noise(second, octaves, 0.6F, seed + 7));
}

// In [-1, 1], one number for each cell.
float tone_of(std::uint32_t column, std::uint32_t row, std::uint32_t seed) {
    return value_noise({1.5F + 7.31F * static_cast<float>(column),
                        2.5F + 5.17F * static_cast<float>(row), 0.5F},
                       seed);
}

}  // namespace

Texture flagstone_texture(std::uint32_t side, std::uint32_t stones) {
    return painted("flagstones", side, [stones](float u, float v) {
        const float y = v * static_cast<float>(stones);
        const auto row = static_cast<std::uint32_t>(y);
        // Every other course is set off by half a stone.
        const float x = u * static_cast<float>(stones) + (row % 2 == 0 ? 0.0F : 0.5F);
        const std::uint32_t column = static_cast<std::uint32_t>(x) % stones;
        const float joint =
            inside(x - std::floor(x), 0.025F) * inside(y - std::floor(y), 0.025F);
        const float tone = 1.0F + 0.13F * tone_of(column, row, 31) +
                           0.10F * repeating_noise(u, v, 9.0F, 4, 41);
        const Imath::V3f stone = Imath::V3f(0.36F, 0.342F, 0.318F) * tone;
        return stone * (0.38F + 0.62F * joint);
    });
}

Texture asphalt_texture(std::uint32_t side) {
    return painted("asphalt", side, [](float u, float v) {
        const float grain = repeating_noise(u, v, 42.0F, 2, 53);
        const float patch = repeating_noise(u, v, 1.6F, 3, 59);
        return Imath::V3f(0.115F, 0.118F, 0.125F) * (1.0F + 0.55F * grain + 0.25F * patch);
    });
}

Texture brick_texture(std::uint32_t side, std::uint32_t across, std::uint32_t courses) {
    return painted("bricks", side, [across, courses](float u, float v) {
        const float y = v * static_cast<float>(courses);
        const auto row = static_cast<std::uint32_t>(y);
        const float x = u * static_cast<float>(across) + (row % 2 == 0 ? 0.0F : 0.5F);
        const std::uint32_t column = static_cast<std::uint32_t>(x) % across;
        const float brick = inside(x - std::floor(x), 0.07F) * inside(y - std::floor(y), 0.17F);
        const float tone = 1.0F + 0.28F * tone_of(column, row, 67) +
                           0.16F * repeating_noise(u, v, 14.0F, 3, 71);
        const Imath::V3f red = Imath::V3f(0.40F, 0.165F, 0.105F) * tone;
        const Imath::V3f mortar(0.42F, 0.39F, 0.35F);
        return mortar + (red - mortar) * brick;
    });
}

}  // namespace relume::scene
