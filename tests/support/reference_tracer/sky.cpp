#include "tests/support/reference_tracer/sky.h"

#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace relume::reference {
namespace {

using Imath::V3d;

double mean(const V3d& rgb) {
    return (rgb.x + rgb.y + rgb.z) / 3.0;
}

// Solid angle per unit of face area (u, v in [-1, 1]) at a face point.
double solid_angle_density(double u, double v) {
    return std::pow(1.0 + u * u + v * v, -1.5);
}

basis::Texel texel_of(std::uint32_t n, const V3d& direction) {
    return basis::texel_from_direction(n, Imath::V3f(direction));
}

}  // namespace

Sky::Sky(std::uint32_t n, Radiance radiance, std::vector<double> importance)
    : n_(n), radiance_(std::move(radiance)), probability_(std::move(importance)) {
    double sum = 0;
    for (std::size_t i = 0; i < probability_.size(); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        probability_[i] *= basis::solid_angle_sr(n, texel.row, texel.column);
        sum += probability_[i];
    }
    double running = 0;
    cumulative_.reserve(probability_.size());
    for (double& probability : probability_) {
        probability /= sum;
        running += probability;
        cumulative_.push_back(running);
    }
}

Sky Sky::from_cubemap(std::uint32_t n, std::span<const Imath::V3f> rgb) {
    const std::vector<Imath::V3f> texels(rgb.begin(), rgb.end());
    std::vector<double> importance;
    double total = 0;
    for (const Imath::V3f& texel : texels) {
        importance.push_back(mean(V3d(texel)));
        total += importance.back();
    }
    // Dark texels are left to the reflection's samples but never to chance alone.
    for (double& value : importance)
        value += 0.05 * total / static_cast<double>(importance.size()) + 1e-12;
    return {n,
            [n, texels](const V3d& direction) {
                return V3d(texels[basis::index_from_texel(n, texel_of(n, direction))]);
            },
            std::move(importance)};
}

Sky Sky::from_function(std::uint32_t n, Radiance radiance) {
    constexpr int kProbes = 8;
    std::vector<double> importance;
    double total = 0;
    for (std::size_t i = 0; i < basis::texel_count(n); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        double sum = 0;
        for (int row = 0; row < kProbes; ++row) {
            for (int column = 0; column < kProbes; ++column) {
                const Imath::V3f direction = basis::direction_from_texel(
                    n, texel, (static_cast<float>(column) + 0.5F) / kProbes,
                    (static_cast<float>(row) + 0.5F) / kProbes);
                sum += mean(radiance(V3d(direction)));
            }
        }
        importance.push_back(sum / (kProbes * kProbes));
        total += importance.back();
    }
    for (double& value : importance)
        value += 0.1 * total / static_cast<double>(importance.size()) + 1e-12;
    return {n, std::move(radiance), std::move(importance)};
}

V3d Sky::radiance(const V3d& direction) const {
    return radiance_(direction);
}

SkySample Sky::sampled(Random& random) const {
    const auto place =
        std::lower_bound(cumulative_.begin(), cumulative_.end() - 1, random.uniform());
    const auto index = static_cast<std::size_t>(place - cumulative_.begin());
    const basis::Texel texel = basis::texel_from_index(n_, index);
    const double width = 2.0 / n_;
    const double u = (texel.column + random.uniform()) * width - 1.0;
    const double v = (texel.row + random.uniform()) * width - 1.0;
    const Imath::V3f point = basis::cube_point_from_face_point(
        {texel.face, static_cast<float>(u), static_cast<float>(v)});
    SkySample sample;
    sample.direction = V3d(point).normalized();
    sample.density = density(sample.direction);
    return sample;
}

double Sky::density(const V3d& direction) const {
    const basis::FacePoint point = basis::face_point_from_direction(Imath::V3f(direction));
    const double width = 2.0 / n_;
    return probability_[basis::index_from_texel(n_, texel_of(n_, direction))] /
           (width * width * solid_angle_density(point.u, point.v));
}

}  // namespace relume::reference
