#include "tests/lab/measures/perceptual_difference.h"

#include "protocol/wire/display.h"
#include "tests/lab/measures/display_exposure.h"

#include <OpenImageIO/imagebufalgo.h>

#include <vector>

namespace relume::lab {
namespace {

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
    constexpr float kWhiteLuminance = 100;
    constexpr float kFieldOfViewDegrees = 45;
    const wire::Display display = display_for(reference);
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
