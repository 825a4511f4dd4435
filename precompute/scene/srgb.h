// IEC 61966-2-1.
#pragma once

#include <algorithm>
#include <cmath>

namespace relume::scene {

// Display-referred [0, 1] to linear; values outside are clamped.
[[nodiscard]] inline float linear_from_srgb(float value) {
    const float v = std::clamp(value, 0.0F, 1.0F);
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

// The inverse.
[[nodiscard]] inline float srgb_from_linear(float value) {
    const float v = std::clamp(value, 0.0F, 1.0F);
    return v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
}

}  // namespace relume::scene
