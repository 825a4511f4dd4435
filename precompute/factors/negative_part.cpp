#include "precompute/factors/negative_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace relume::factors {
namespace {

constexpr std::size_t kPairs = 1U << 15U;

// The additive recurrence of the powers of 1/x, x⁵ = x + 1: four numbers in [0, 1)
// [Roberts18].
std::array<double, 4> evenly_spread(std::size_t i) {
    constexpr double kRatio = 1 / 1.1673039782614187;
    std::array<double, 4> point{};
    double step = 1;
    for (double& coordinate : point) {
        step *= kRatio;
        const double at = 0.5 + step * static_cast<double>(i + 1);
        coordinate = at - std::floor(at);
    }
    return point;
}

Imath::V3f cosine_weighted(double u, double v) {
    const double radius = std::sqrt(u);
    const double phi = 2 * std::numbers::pi * v;
    return Imath::V3f(
        Imath::V3d(radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1 - u)));
}

}  // namespace

NegativePart negative_part(const brdf::FactoredBrdf& brdf,
                           std::span<const Imath::V3f> colours) {
    NegativePart part;
    for (std::size_t i = 0; i < kPairs; ++i) {
        const auto [a, b, c, d] = evenly_spread(i);
        const Imath::V3f value =
            brdf.evaluate(cosine_weighted(a, b), cosine_weighted(c, d), colours);
        for (int colour = 0; colour < 3; ++colour) {
            const double below = std::max(0.0F, -value[colour]);
            part.largest = std::max(part.largest, below);
            part.mean_square += below * below / (3 * kPairs);
        }
    }
    return part;
}

}  // namespace relume::factors
