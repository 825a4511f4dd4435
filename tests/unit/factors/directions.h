// Directions and values for tests of factored BRDFs.
#pragma once

#include "precompute/factors/brdf_lobes.h"

#include <Imath/ImathVec.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace relume::factors {

[[nodiscard]] inline Imath::V3f direction_from_angles(double theta, double phi) {
    return Imath::V3f(Imath::V3d(std::sin(theta) * std::cos(phi),
                                 std::sin(theta) * std::sin(phi), std::cos(theta)));
}

[[nodiscard]] inline Imath::V3f turned(const Imath::V3f& d, double angle) {
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    return {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

class CosineDirections {
  public:
    explicit CosineDirections(unsigned seed) : random_(seed) {}

    [[nodiscard]] Imath::V3f next() {
        const double sine = std::sqrt(uniform_(random_));
        return direction_from_angles(std::asin(sine), 2 * std::numbers::pi * uniform_(random_));
    }

  private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_{0, 0.999999};
};

// Every lobe towards wo from wi.
[[nodiscard]] inline std::vector<float> values_of(const BrdfLobes& lobes,
                                                  const Imath::V3f& wi,
                                                  const Imath::V3f& wo) {
    std::vector<float> values(lobes.count());
    lobes.evaluate(wo, {{&wi.x, 1}, {&wi.y, 1}, {&wi.z, 1}}, values);
    return values;
}

[[nodiscard]] inline Imath::V3f colour_of(const BrdfLobes& lobes,
                                          const Imath::V3f& wi,
                                          const Imath::V3f& wo) {
    Imath::V3f sum(0, 0, 0);
    const std::vector<float> values = values_of(lobes, wi, wo);
    for (std::size_t l = 0; l < lobes.count(); ++l) {
        sum += lobes.mean_colours[l] * values[l];
    }
    return sum;
}

// One white lobe, a function of both directions.
[[nodiscard]] inline BrdfLobes lobe_from(
    const std::function<double(const Imath::V3f& wi, const Imath::V3f& wo)>& function,
    double width_rad = 1) {
    return {{{1, 1, 1}},
            width_rad,
            [function](const Imath::V3f& wo, const brdf::Directions& wi, std::span<float> out) {
                for (std::size_t i = 0; i < wi.size(); ++i) {
                    out[i] = static_cast<float>(function({wi.x[i], wi.y[i], wi.z[i]}, wo));
                }
            }};
}

}  // namespace relume::factors
