// Directions and refusals for tests of curves.
#pragma once

#include "protocol/curve/error.h"

#include <Imath/ImathVec.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

namespace relume::curve {

[[nodiscard]] inline Imath::V3f direction_from_degrees(double theta, double phi) {
    const double t = theta * std::numbers::pi / 180;
    const double p = phi * std::numbers::pi / 180;
    return Imath::V3f(
        Imath::V3d(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)));
}

// Uniform over the upper hemisphere.
class HemisphereDirections {
  public:
    explicit HemisphereDirections(unsigned seed) : random_(seed) {}

    [[nodiscard]] Imath::V3f next() {
        const double z = 1 - uniform_(random_);
        const double phi = 360 * uniform_(random_);
        return direction_from_degrees(std::acos(z) * 180 / std::numbers::pi, phi);
    }

  private:
    std::mt19937 random_;
    std::uniform_real_distribution<double> uniform_{0, 0.999999};
};

// Also that the message says what was expected.
inline void expect_curve_error(const std::function<void()>& action, const std::string& part) {
    try {
        action();
        ADD_FAILURE() << "accepted, expected: " << part;
    } catch (const CurveError& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find(part), std::string::npos) << message;
        EXPECT_NE(message.find("expected"), std::string::npos) << message;
    }
}

}  // namespace relume::curve
