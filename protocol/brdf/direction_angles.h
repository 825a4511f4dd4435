// Polar and azimuthal angle of a direction, without branches and table look-ups, so that loops
// over many directions vectorise and give the bits that one direction gives.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::brdf {

// atan(ratio) for 0 ≤ ratio ≤ 1, to 2e-7: the polynomial of degree 7 in ratio² that
// interpolates atan(ratio)/ratio at Chebyshev's points.
[[nodiscard]] inline float arctangent(float ratio) {
    const float s = ratio * ratio;
    float p = -0.00466877331F;
    p = p * s + 0.0241661895F;
    p = p * s - 0.0593671008F;
    p = p * s + 0.0990609690F;
    p = p * s - 0.140165850F;
    p = p * s + 0.199692354F;
    p = p * s - 0.333319597F;
    p = p * s + 0.999999898F;
    return p * ratio;
}

// The angle of (x, y) in [0, π/2] for x, y ≥ 0; 0 where both are 0.
[[nodiscard]] inline float first_quadrant_angle(float x, float y) {
    constexpr float kHalfPi = std::numbers::pi_v<float> / 2;
    const float larger = x > y ? x : y;
    const float smaller = x > y ? y : x;
    const float angle = arctangent(smaller / (larger > 1e-30F ? larger : 1e-30F));
    return x > y ? angle : kHalfPi - angle;
}

// θ from the z axis, in [0, π/2], for z ≥ 0; (x, y, z) may have any length.
[[nodiscard]] inline float polar_angle(float x, float y, float z) {
    return first_quadrant_angle(z, std::sqrt(x * x + y * y));
}

// φ from x to y, in [0, 2π].
[[nodiscard]] inline float azimuthal_angle(float x, float y) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float quadrant = first_quadrant_angle(std::fabs(x), std::fabs(y));
    const float half = x < 0 ? kPi - quadrant : quadrant;
    return y < 0 ? 2 * kPi - half : half;
}

}  // namespace relume::brdf
