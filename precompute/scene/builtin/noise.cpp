#include "precompute/scene/builtin/noise.h"

#include <bit>
#include <cmath>

namespace relume::scene {
namespace {

constexpr float kUnit = 1.0F / 16777216.0F;  // 2^-24

// [Jarzynski20], pcg3d reduced to one word.
float lattice_value(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    std::uint32_t a = static_cast<std::uint32_t>(x) * 1664525U + 1013904223U + seed;
    std::uint32_t b = static_cast<std::uint32_t>(y) * 1664525U + 1013904223U;
    std::uint32_t c = static_cast<std::uint32_t>(z) * 1664525U + 1013904223U;
    a += b * c;
    b += c * a;
    c += a * b;
    a ^= a >> 16U;
    b ^= b >> 16U;
    c ^= c >> 16U;
    a += b * c;
    return static_cast<float>(a >> 8U) * kUnit * 2.0F - 1.0F;
}

float eased(float t) {
    return t * t * (3.0F - 2.0F * t);
}

float mix(float a, float b, float t) {
    return a + (b - a) * t;
}

}  // namespace

std::uint32_t Random::next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005U + 1442695040888963407U;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    return std::rotr(shifted, static_cast<int>(old >> 59U));
}

float Random::uniform(float low, float high) {
    return low + (high - low) * (static_cast<float>(next() >> 8U) * kUnit);
}

float value_noise(const Imath::V3f& p, std::uint32_t seed) {
    const float fx = std::floor(p.x);
    const float fy = std::floor(p.y);
    const float fz = std::floor(p.z);
    const auto x = static_cast<std::int32_t>(fx);
    const auto y = static_cast<std::int32_t>(fy);
    const auto z = static_cast<std::int32_t>(fz);
    const float tx = eased(p.x - fx);
    const float ty = eased(p.y - fy);
    const float tz = eased(p.z - fz);
    const auto edge = [&](std::int32_t dy, std::int32_t dz) {
        return mix(lattice_value(x, y + dy, z + dz, seed),
                   lattice_value(x + 1, y + dy, z + dz, seed), tx);
    };
    return mix(mix(edge(0, 0), edge(1, 0), ty), mix(edge(0, 1), edge(1, 1), ty), tz);
}

float fractal_noise(const Imath::V3f& point,
                    std::uint32_t octaves,
                    float gain,
                    std::uint32_t seed) {
    float sum = 0;
    float height = 1;
    Imath::V3f place = point;
    for (std::uint32_t octave = 0; octave < octaves; ++octave) {
        sum += height * value_noise(place, seed + octave);
        height *= gain;
        place *= 2.0F;
    }
    return sum;
}

}  // namespace relume::scene
