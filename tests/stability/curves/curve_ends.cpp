// Fresnel's curve rises at its end: wavelets are periodic, and those that hold the rise reach
// around to the beginning.
#include "protocol/basis/daubechies4.h"
#include "protocol/curve/curve_shape.h"
#include "tests/stability/curves/baked_ball.h"
#include "tests/stability/provocations.h"
#include "tests/stability/test_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr double kBegins = 0.05;  // of u: the middle of the ball
constexpr std::uint32_t kMostImages = 20;

// Of a line from 0 to 1, whose values no wavelet holds that does not reach around.
int wavelets_of_a_line() {
    std::array<float, curve::kCurveSamples> line{};
    for (std::size_t k = 0; k < line.size(); ++k) {
        line[k] = static_cast<float>(curve::curve_u(k));
    }
    basis::daubechies4_forward(line, line);
    constexpr float kRounding = 1e-5F;
    return static_cast<int>(std::count_if(line.begin() + 1, line.end(),
                                          [](float c) { return std::abs(c) > kRounding; }));
}

double most_off_at_the_beginning(const curve::Curve& shown, const curve::Curve& asked) {
    double most = 0;
    for (std::size_t k = 0; curve::curve_u(k) < kBegins; ++k) {
        most = std::max(most, std::abs(double{shown.rgb[0][k]} - double{asked.rgb[0][k]}));
    }
    return most;
}

Outcome provoke(Workbench& workbench) {
    const BakedBall ball(constant_sky(16, 1), {.curve = "fresnel"});
    workbench.progress("curve_ends", 0.8);
    const std::array<Imath::V3d, 2> values{Imath::V3d(0.04), Imath::V3d(1)};
    const curve::Curve flat = curve::constant_curve(Imath::V3f(0.04F));
    const curve::Curve rising = curve::curve_from_shape(curve::CurveShape::schlick,
                                                        curve::CurveAngle::difference, values);

    const auto few = ball.follow(flat, rising, 10);
    std::uint32_t images = 1;
    while (images < kMostImages && !ball.follow(flat, rising, 30, images).is_exact) {
        ++images;
    }
    const auto rested = ball.follow(flat, rising, 30, images);
    const RelitImage exact = ball.image(rising);
    const RelitImage truth = ball.reflected(rising);
    const int line = wavelets_of_a_line();

    Outcome outcome;
    outcome.findings = {
        {"a line from 0 to 1: wavelets that it has", Sense::at_least, 8,
         static_cast<double>(line), "one of every level reaches around the end"},
        {"the same", Sense::at_most, 16, static_cast<double>(line),
         "all others are orthogonal to lines; four taps reach around by two places at most"},
        {"10 columns: the beginning of the curve is off, over its rise at the end",
         Sense::at_least, 0.005, most_off_at_the_beginning(few.curve, rising) / 0.96,
         "wavelets that hold the rise reach around"},
        {"10 columns: image error", Sense::at_most, 0.1,
         distance(few.image, exact) / norm(exact),
         "columns are chosen by the image, where the beginning is a spot in the middle"},
        {"images of 30 columns until exact", Sense::at_most, 9, static_cast<double>(images),
         "a curve has 256 coefficients"},
        {"exact: the beginning is off, over the rise", Sense::at_most, 1e-5,
         most_off_at_the_beginning(rested.curve, rising) / 0.96, "rounding alone"},
        {"exact image, beside the integral of the BRDF", Sense::at_most, 0.06,
         distance(exact, truth) / norm(truth), "64 samples a pixel, and storing"},
    };
    const float exposure = exposure_for(truth);
    outcome.tiles = {{truth, "Schlick's curve: its integral", exposure},
                     {few.image, "10 columns", exposure},
                     {absolute_difference(few.image, exact, 10), "10 times what is off", 0},
                     {exact, "exact", exposure}};
    return outcome;
}

}  // namespace

Failure curve_ends() {
    return {.name = "curve_ends",
            .what = "what changes at one end of a curve shows at the other",
            .scene =
                "a ball (GGX, alpha 0.2) under a white sky, 32x32, whose Fresnel curve becomes "
                "Schlick's",
            .provoke = provoke};
}

}  // namespace relume::stability
