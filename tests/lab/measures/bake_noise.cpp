#include "tests/lab/measures/bake_noise.h"

#include "tests/lab/measures/perceptual_difference.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::lab {
namespace {

NoiseKind kind_of(PixelContent content, float key_open) {
    constexpr float kLeastPart = 0.02F;
    if (content == PixelContent::edge) {
        return kEdge;
    }
    if (key_open > kLeastPart && key_open < 1 - kLeastPart) {
        return kPenumbra;
    }
    return content == PixelContent::gloss ? kGloss : kMatte;
}

}  // namespace

double KindNoise::relative_rmse() const {
    return energy > 0 ? std::sqrt(std::max(0.0, squared_error) / energy) : 0;
}

double KindNoise::mean_delta_e() const {
    const double sum = std::accumulate(delta_e.begin(), delta_e.end(), 0.0);
    return delta_e.empty() ? 0 : sum / static_cast<double>(delta_e.size());
}

double KindNoise::delta_e_quantile(double part) const {
    if (delta_e.empty()) {
        return 0;
    }
    std::vector<double> values = delta_e;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

void KindNoise::add(const KindNoise& other) {
    squared_error += other.squared_error;
    energy += other.energy;
    delta_e.insert(delta_e.end(), other.delta_e.begin(), other.delta_e.end());
}

BakeNoise bake_noise(std::span<const float> picture,
                     const BakeReference& reference,
                     std::size_t light) {
    const LitReference& lit = reference.lit[light];
    const std::vector<double> delta_e = pixel_delta_e(picture, lit.picture());
    BakeNoise noise;
    for (std::size_t pixel = 0; pixel < reference.content.size(); ++pixel) {
        if (reference.content[pixel] == PixelContent::nothing) {
            continue;
        }
        KindNoise& kind = noise[kind_of(reference.content[pixel], lit.key_open[pixel])];
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double first = lit.half[0][i];
            const double second = lit.half[1][i];
            const double shown = picture[i];
            kind.squared_error += (shown - first) * (shown - second);
            kind.energy += first * second;
        }
        kind.delta_e.push_back(delta_e[pixel]);
    }
    return noise;
}

}  // namespace relume::lab
