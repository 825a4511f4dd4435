// A highlight narrower than what it was baked for: the curve's samples, the directions that the
// bake draws, and the steps in which columns are stored.
#include "precompute/bake/curves/frozen_light.h"
#include "protocol/curve/curve_shape.h"
#include "tests/stability/curves/baked_ball.h"
#include "tests/stability/provocations.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace relume::stability {
namespace {

constexpr std::uint32_t kFaceResolution = 32;
constexpr double kSharpest = 0.001;  // that a shape may be

curve::Curve of_roughness(double alpha) {
    const std::array<Imath::V3d, 1> values{Imath::V3d(alpha)};
    return curve::curve_from_shape(curve::CurveShape::ggx, curve::CurveAngle::half, values);
}

// ∫ D cos θ dω, D being linear between 256 samples of a distribution in u, u² · 90° or u · 90°.
double energy(double alpha, const std::function<double(double u)>& angle) {
    const auto d = [&](double theta) {
        const double c = std::cos(theta);
        const double s = std::sin(theta);
        return alpha * alpha / (std::numbers::pi * std::pow(alpha * alpha * c * c + s * s, 2));
    };
    const curve::Curve sampled =
        curve::curve_from_function([&](double u) { return Imath::V3d(d(angle(u))); });
    constexpr int kSteps = 1 << 18;
    double sum = 0;
    double before = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = angle((i + 1.0) / kSteps);
        const double middle = angle((i + 0.5) / kSteps);
        sum += double{sampled.at(static_cast<float>((i + 0.5) / kSteps)).x} * 2 *
               std::numbers::pi * std::sin(middle) * std::cos(middle) * (theta - before);
        before = theta;
    }
    return sum;
}

Outcome provoke(Workbench& workbench) {
    const light::LightCubemap light =
        bake::frozen_light({.environment = "studio-softboxes"}, kFaceResolution).cubemap;
    const BakedBall ball(light);
    workbench.progress("narrow_highlights", 0.4);
    const BakedBall hasty(light, {.samples = 4});
    workbench.progress("narrow_highlights", 0.6);
    const auto root = [](double u) { return u * u * std::numbers::pi / 2; };
    const auto even = [](double u) { return u * std::numbers::pi / 2; };

    const curve::Curve narrow = of_roughness(0.03);
    const curve::Curve narrower = of_roughness(0.01);
    const curve::Curve sharpest = of_roughness(kSharpest);
    const RelitImage baked_image = ball.image(ball.baked());
    const RelitImage narrow_image = ball.image(narrow);
    const RelitImage hasty_image = hasty.image(narrow);
    const RelitImage narrower_image = ball.image(narrower);
    const RelitImage sharpest_image = ball.image(sharpest);
    const RelitImage baked_truth = ball.reflected(ball.baked());
    const RelitImage narrow_truth = ball.reflected(narrow);
    const RelitImage narrower_truth = ball.reflected(narrower);
    const RelitImage sharpest_truth = ball.reflected(sharpest);
    const auto error = [](const RelitImage& image, const RelitImage& truth) {
        return distance(image, truth) / norm(truth);
    };

    Outcome outcome;
    outcome.findings = {
        {"samples evenly over θ: energy of the sharpest distribution off", Sense::at_least, 1,
         std::abs(energy(kSharpest, even) - 1),
         "the first sample lies 0.35 degrees from the normal, six widths away"},
        {"samples over its root: the same", Sense::at_most, 0.025,
         std::abs(energy(kSharpest, root) - 1), "a width has six samples"},
        {"as baked: image error beside the integral", Sense::at_most, 0.05,
         error(baked_image, baked_truth), "64 samples a pixel"},
        {"7 times narrower, 4 samples a pixel: the same", Sense::at_least, 0.1,
         error(hasty_image, narrow_truth), "few of the directions meet so narrow a highlight"},
        {"7 times narrower, 64 samples: the same", Sense::at_most, 0.12,
         error(narrow_image, narrow_truth),
         "every sample of the curve has its share of the directions, whatever the light is"},
        {"20 times narrower, 64 samples: the same", Sense::reported, 0,
         error(narrower_image, narrower_truth), ""},
        {"200 times narrower, the sharpest: the same", Sense::at_least, 0.5,
         error(sharpest_image, sharpest_truth),
         "its peak is 40,000 times that of the curve as baked, and so is what storing leaves "
         "off; steps are for four times narrower"},
    };
    const float exposure = exposure_for(narrow_truth);
    outcome.tiles = {{baked_image, "alpha 0.2, as baked", exposure},
                     {hasty_image, "0.03, 4 samples", exposure},
                     {narrow_image, "0.03, 64 samples", exposure},
                     {narrower_image, "0.01", exposure},
                     {sharpest_image, "0.001", exposure},
                     {narrow_truth, "0.03: its integral", exposure},
                     {narrower_truth, "0.01: its integral", exposure},
                     {sharpest_truth, "0.001: its integral", exposure}};
    return outcome;
}

}  // namespace

Failure narrow_highlights() {
    return {.name = "narrow_highlights",
            .what = "a highlight much narrower than baked is noise",
            .scene =
                "a ball (GGX, alpha 0.2) under studio-softboxes, 32x32, n = 32, whose "
                "distribution becomes narrower",
            .provoke = provoke};
}

}  // namespace relume::stability
