#include "tests/lab/curves/curve_edits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace relume::lab {
namespace {

constexpr std::uint32_t kPeriod = 60;  // images, of changes that come again

double phase(std::uint32_t number) {
    return 0.5 - 0.5 * std::cos(2 * std::numbers::pi * number / kPeriod);
}

// The curve stretched along u: f < 1 narrows it.
curve::Curve stretched(const curve::Curve& baked, double f) {
    curve::Curve curve;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        curve.set_sample(k, baked.at(static_cast<float>(std::min(1.0, curve::curve_u(k) / f))));
    }
    return curve;
}

// The value that a tenth of the samples exceed: a highlight's, not its peak's.
Imath::V3f usual_value(const curve::Curve& baked) {
    Imath::V3f value;
    for (int channel = 0; channel < 3; ++channel) {
        auto sorted = baked.rgb[static_cast<std::size_t>(channel)];
        std::sort(sorted.begin(), sorted.end());
        value[channel] = std::max(sorted[sorted.size() * 9 / 10], 1e-3F);
    }
    return value;
}

curve::Curve with_bump(const curve::Curve& baked, double centre) {
    constexpr double kWidth = 0.1;
    const Imath::V3f height = usual_value(baked);
    curve::Curve curve = baked;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        const double x = 2 * (curve::curve_u(k) - centre) / kWidth;
        if (std::abs(x) < 1) {
            const double bump = 0.5 + 0.5 * std::cos(std::numbers::pi * x);
            curve.set_sample(k, baked.sample(k) + height * static_cast<float>(bump));
        }
    }
    return curve;
}

curve::Curve with_step(const curve::Curve& baked, std::uint32_t number) {
    std::mt19937 random(number + 1);
    std::uniform_int_distribution<std::size_t> place(16, curve::kCurveSamples - 17);
    const Imath::V3f height = usual_value(baked);
    curve::Curve curve = baked;
    for (std::size_t k = place(random); k < curve::kCurveSamples; ++k) {
        curve.set_sample(k, baked.sample(k) + height);
    }
    return curve;
}

curve::Curve random_curve(const curve::Curve& baked, std::uint32_t number) {
    std::mt19937 random(number + 1);
    std::uniform_real_distribution<float> value(0, 2);
    const Imath::V3f height = usual_value(baked);
    curve::Curve curve;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        curve.set_sample(
            k, {height.x * value(random), height.y * value(random), height.z * value(random)});
    }
    return curve;
}

}  // namespace

std::string_view name_of(CurveChange change) {
    switch (change) {
        case CurveChange::local:
            return "local";
        case CurveChange::global:
            return "global";
        case CurveChange::discontinuous:
            return "discontinuous";
        case CurveChange::random:
            return "random";
    }
    return {};
}

curve::Curve changed_curve(const curve::Curve& baked,
                           CurveChange change,
                           std::uint32_t number) {
    switch (change) {
        case CurveChange::local:
            return with_bump(baked, 0.1 + 0.8 * phase(number));
        case CurveChange::global:
            return stretched(baked, 0.6 + 0.8 * phase(number));
        case CurveChange::discontinuous:
            return with_step(baked, number);
        case CurveChange::random:
            return random_curve(baked, number);
    }
    return baked;
}

}  // namespace relume::lab
