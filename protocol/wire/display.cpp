#include "protocol/wire/display.h"

#include <algorithm>
#include <cmath>

namespace relume::wire {

float tone_mapped(float linear, const Display& display) {
    // A NaN has no place in an image; shown, it is black.
    const float x =
        std::max(0.0F, linear) * std::exp2(static_cast<float>(display.exposure_stops));
    if (display.tone == Tone::linear) {
        return std::min(x, 1.0F);
    }
    // The quotient tends to 2.51/2.43; clamping x first keeps its squares finite.
    const float bounded = std::min(x, 1e6F);
    return std::clamp(
        bounded * (2.51F * bounded + 0.03F) / (bounded * (2.43F * bounded + 0.59F) + 0.14F),
        0.0F, 1.0F);
}

float srgb_from_linear(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear
                                : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

std::uint8_t code_from_linear(float linear, const Display& display) {
    const float srgb = srgb_from_linear(tone_mapped(linear, display));
    return static_cast<std::uint8_t>(std::clamp(srgb * 255.0F + 0.5F, 0.0F, 255.0F));
}

}  // namespace relume::wire
