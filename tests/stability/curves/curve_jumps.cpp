// A curve with a jump: few wavelets ring beside it, above and below.
#include "tests/stability/curves/baked_ball.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <algorithm>

namespace relume::stability {
namespace {

curve::Curve jump() {
    return curve::curve_from_function([](double u) { return Imath::V3d(u < 0.45 ? 1 : 0); });
}

double highest(const curve::Curve& curve) {
    return double{*std::max_element(curve.rgb[0].begin(), curve.rgb[0].end())};
}
double lowest(const curve::Curve& curve) {
    return double{*std::min_element(curve.rgb[0].begin(), curve.rgb[0].end())};
}
double lowest(const RelitImage& image) {
    return double{*std::min_element(image.rgb.begin(), image.rgb.end())};
}

Outcome provoke(Workbench& workbench) {
    const BakedBall ball(constant_sky(16, 1), {.curve = "fresnel"});
    workbench.progress("curve_jumps", 0.8);
    const curve::Curve flat = curve::constant_curve(Imath::V3f(0.5F));
    const auto after_10 = ball.follow(flat, jump(), 10);
    const auto after_30 = ball.follow(flat, jump(), 30);
    const auto after_60 = ball.follow(flat, jump(), 30, 2);
    const RelitImage exact = ball.image(jump());
    const RelitImage truth = ball.reflected(jump());
    const double white = double{*std::max_element(truth.rgb.begin(), truth.rgb.end())};
    const auto error = [&](const RelitImage& image) {
        return distance(image, exact) / norm(exact);
    };

    Outcome outcome;
    outcome.findings = {
        {"10 columns: the curve rises above the jump's top", Sense::at_least, 0.02,
         highest(after_10.curve) - 1, "wavelets that are missing would take it off"},
        {"10 columns: the curve falls below zero", Sense::at_least, 0.02,
         -lowest(after_10.curve), "the same, below"},
        {"10 columns: image error", Sense::reported, 0, error(after_10.image), ""},
        {"30 columns: image error", Sense::at_most, error(after_10.image),
         error(after_30.image), "more of the wavelets that a jump has are there"},
        {"two images of 30 columns: image error", Sense::at_most, 1e-6, error(after_60.image),
         "a jump touches three wavelets of every level, as does the one where the curve's end "
         "meets its beginning: 49 coefficients at most, and the rounding of the others"},
        {"exact: the image falls below zero, over white", Sense::at_most, 0.005,
         -lowest(exact) / white, "nothing rings at rest; the rest is storing"},
        {"exact image, beside the integral of the BRDF", Sense::at_most, 0.03,
         distance(exact, truth) / norm(truth), "64 samples a pixel, and storing"},
    };
    const float exposure = exposure_for(truth);
    outcome.tiles = {{truth, "a jump: its integral", exposure},
                     {after_10.image, "10 columns", exposure},
                     {after_30.image, "30 columns", exposure},
                     {exact, "exact", exposure}};
    return outcome;
}

}  // namespace

Failure curve_jumps() {
    return {.name = "curve_jumps",
            .what = "a jump of a curve rings",
            .scene =
                "a ball (GGX, alpha 0.2) under a white sky, 32x32, whose Fresnel curve falls "
                "from 1 to 0",
            .provoke = provoke};
}

}  // namespace relume::stability
