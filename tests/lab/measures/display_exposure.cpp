#include "tests/lab/measures/display_exposure.h"

#include <cmath>

namespace relume::lab {

wire::Display display_for(std::span<const float> rgb) {
    constexpr double kMiddleGrey = 0.18;
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
        // Rec. 709
        sum +=
            0.2126 * double{rgb[i]} + 0.7152 * double{rgb[i + 1]} + 0.0722 * double{rgb[i + 2]};
    }
    const double luminance = 3 * sum / static_cast<double>(rgb.size());
    wire::Display display;
    display.exposure_stops = luminance > 0 ? std::log2(kMiddleGrey / luminance) : 0;
    return display;
}

}  // namespace relume::lab
