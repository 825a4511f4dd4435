#include "tests/lab/measures/perceptual_difference.h"

#include "protocol/wire/display.h"

#include <OpenImageIO/imagebufalgo.h>

#include <cmath>
#include <vector>

namespace relume::lab {
namespace {

double mean_luminance(std::span<const float> rgb) {
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        sum +=
            0.2126 * double{rgb[i]} + 0.7152 * double{rgb[i + 1]} + 0.0722 * double{rgb[i + 2]};
    }
    return 3 * sum / static_cast<double>(rgb.size());
}

std::vector<float> display_linear(std::span<const float> rgb, const wire::Display& display) {
    std::vector<float> values;
    values.reserve(rgb.size());
    for (const float value : rgb) {
        values.push_back(wire::tone_mapped(value, display));
    }
    return values;
}

}  // namespace

double visible_part(std::span<const float> image,
                    std::span<const float> reference,
                    std::uint32_t width) {
    constexpr double kMiddleGrey = 0.18;
    constexpr float kWhiteLuminance = 100;
    constexpr float kFieldOfViewDegrees = 45;
    const double luminance = mean_luminance(reference);
    wire::Display display;
    display.exposure_stops = luminance > 0 ? std::log2(kMiddleGrey / luminance) : 0;
    std::vector<float> values = display_linear(image, display);
    std::vector<float> reference_values = display_linear(reference, display);
    const auto rows = static_cast<int>(reference.size() / (3 * std::size_t{width}));
    const OIIO::ImageSpec spec(static_cast<int>(width), rows, 3, OIIO::TypeDesc::FLOAT);
    const OIIO::ImageBuf a(spec, values.data());
    const OIIO::ImageBuf b(spec, reference_values.data());
    OIIO::ImageBufAlgo::CompareResults results;
    const int failing = OIIO::ImageBufAlgo::compare_Yee(a, b, results, kWhiteLuminance,
                                                        kFieldOfViewDegrees, {}, 1);
    return static_cast<double>(failing) / (static_cast<double>(width) * rows);
}

}  // namespace relume::lab
