// The rim of a ball is seen at grazing angles, where a microfacet BRDF divides by both cosines,
// and where masking stays that of the roughness that was baked.
#include "protocol/curve/curve_shape.h"
#include "tests/stability/curves/baked_ball.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr double kRim = 0.5;  // cosines to the viewer below it

curve::Curve of_roughness(double alpha) {
    const std::array<Imath::V3d, 1> values{Imath::V3d(alpha)};
    return curve::curve_from_shape(curve::CurveShape::ggx, curve::CurveAngle::half, values);
}

double not_finite(const RelitImage& image) {
    return static_cast<double>(std::count_if(image.rgb.begin(), image.rgb.end(),
                                             [](float v) { return !std::isfinite(v); }));
}

double brightest(const RelitImage& image) {
    return double{*std::max_element(image.rgb.begin(), image.rgb.end())};
}

// Root mean square over the pixels of the rim, over the truth's.
double off_at_rim(const BakedBall& ball, const RelitImage& image, const RelitImage& truth) {
    double error = 0;
    double squares = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const double cosine = ball.cosine_to_viewer(x, y);
            if (cosine > 0 && cosine < kRim) {
                const std::size_t i = 3 * (std::size_t{y} * image.width + x);
                error += std::pow(double{image.rgb[i]} - double{truth.rgb[i]}, 2);
                squares += std::pow(double{truth.rgb[i]}, 2);
            }
        }
    }
    return std::sqrt(error / squares);
}

Outcome provoke(Workbench& workbench) {
    const BakedBall ball(constant_sky(16, 1));
    workbench.progress("rim_of_pearls", 0.6);
    constexpr double kGrazing = 0.1 * M_PI / 180;
    const Imath::V3f low(static_cast<float>(std::cos(kGrazing)), 0,
                         static_cast<float>(std::sin(kGrazing)));
    const double rise = double{ball.brdf().quotient(ball.edited(), low, {-low.x, 0, low.z}).x} /
                        double{ball.brdf().quotient(ball.edited(), {0, 0, 1}, {0, 0, 1}).x};

    const curve::Curve rough = of_roughness(1);
    const RelitImage as_baked = ball.image(ball.baked());
    const RelitImage sharper = ball.image(of_roughness(0.03));
    const RelitImage rougher = ball.image(rough);
    const RelitImage highest =
        ball.image(curve::constant_curve(Imath::V3f(curve::kMostCurveValue)));
    const RelitImage truth = ball.reflected(rough);

    Outcome outcome;
    outcome.findings = {
        {"the BRDF without its curve, 0.1 degrees over the horizon, over that straight on",
         Sense::at_least, 1e3, rise, "1/(4 cos θi cos θo), which masking tames by one"},
        {"image values not finite, as baked, sharper, rougher, and the highest curve there is",
         Sense::at_most, 0,
         not_finite(as_baked) + not_finite(sharper) + not_finite(rougher) + not_finite(highest),
         "cosines below 1e-4 count as 1e-4"},
        {"as baked (alpha 0.2): brightest", Sense::at_most, 1.02, brightest(as_baked),
         "no surface gives more than it gets; two hundredths are for noise and storing"},
        {"sharper by its curve (0.03): brightest", Sense::at_most, 1.1, brightest(sharper),
         "masking of a rougher surface takes more away; noise of 64 samples"},
        {"rougher by its curve (1): brightest", Sense::at_least, 1.1, brightest(rougher),
         "masking stays that of 0.2, so that rims shine more than a rough surface can"},
        {"the same, over what the integral of that BRDF gives", Sense::at_most, 1.15,
         brightest(rougher) / brightest(truth), "what is shown is the product of the curves"},
        {"rougher: the rim (above 60 degrees), beside the integral", Sense::at_most, 0.1,
         off_at_rim(ball, rougher, truth),
         "pixels whose cosines run to zero are averages over their places"},
    };
    outcome.tiles = {{as_baked, "alpha 0.2, as baked", 0},
                     {sharper, "0.03 by its curve", 0},
                     {rougher, "1 by its curve", 0},
                     {truth, "1: the integral", 0}};
    return outcome;
}

}  // namespace

Failure rim_of_pearls() {
    return {.name = "rim_of_pearls",
            .what = "rims blow up at grazing angles",
            .scene =
                "a ball (GGX, alpha 0.2, all light reflected) under a white sky, 32x32, whose "
                "distribution is that of other roughness",
            .provoke = provoke};
}

}  // namespace relume::stability
