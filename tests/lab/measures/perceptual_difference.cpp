#include "tests/lab/measures/perceptual_difference.h"

#include "protocol/wire/display.h"
#include "tests/lab/measures/display_exposure.h"

#include <array>
#include <cmath>
#include <numeric>

namespace relume::lab {
namespace {

// CIE 15's function of a tristimulus value over that of white.
double lightness_from_ratio(double ratio) {
    constexpr double kDelta = 6.0 / 29.0;
    return ratio > kDelta * kDelta * kDelta ? std::cbrt(ratio)
                                            : ratio / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

// L*, a*, b* of display-linear Rec. 709; the rows are XYZ over those of D65's white.
std::array<double, 3> lab_from_display(const std::array<double, 3>& rgb) {
    constexpr double kRatios[3][3] = {{0.433949, 0.376223, 0.189828},
                                      {0.212639, 0.715169, 0.072192},
                                      {0.017756, 0.109468, 0.872776}};
    std::array<double, 3> f{};
    for (std::size_t i = 0; i < f.size(); ++i) {
        f[i] = lightness_from_ratio(kRatios[i][0] * rgb[0] + kRatios[i][1] * rgb[1] +
                                    kRatios[i][2] * rgb[2]);
    }
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

std::array<double, 3> lab_of_pixel(std::span<const float> rgb, const wire::Display& display) {
    return lab_from_display({double{wire::tone_mapped(rgb[0], display)},
                             double{wire::tone_mapped(rgb[1], display)},
                             double{wire::tone_mapped(rgb[2], display)}});
}

}  // namespace

std::vector<double> pixel_delta_e(std::span<const float> image,
                                  std::span<const float> reference) {
    const wire::Display display = display_for(reference);
    std::vector<double> distances;
    distances.reserve(reference.size() / 3);
    for (std::size_t i = 0; i < reference.size(); i += 3) {
        const auto a = lab_of_pixel(image.subspan(i, 3), display);
        const auto b = lab_of_pixel(reference.subspan(i, 3), display);
        distances.push_back(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    return distances;
}

double mean_delta_e(std::span<const float> image, std::span<const float> reference) {
    const std::vector<double> distances = pixel_delta_e(image, reference);
    return std::accumulate(distances.begin(), distances.end(), 0.0) /
           static_cast<double>(distances.size());
}

}  // namespace relume::lab
