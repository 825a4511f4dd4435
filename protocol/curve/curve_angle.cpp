#include "protocol/curve/curve_angle.h"

#include "protocol/brdf/direction_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::curve {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

float polar_angle(const Imath::V3f& direction) {
    return brdf::polar_angle(direction.x, direction.y, direction.z);
}

// Half the angle between two unit vectors, in [0, π/2]; keeps its digits where it is small.
float half_angle_between(const Imath::V3f& a, const Imath::V3f& b) {
    return brdf::first_quadrant_angle((a + b).length(), (a - b).length());
}

// θ with cos θ = (cos θ_h)^power, where cos² θ_h = z²/(sin2 + z²).
float spread_angle(float sin2, float z, double power) {
    // Not through the cosine, which has no digits left near the normal.
    const double tan2 = static_cast<double>(sin2) / (static_cast<double>(z) * z);
    const double versine = -std::expm1(-0.5 * power * std::log1p(tan2));  // 1 − cos θ
    return static_cast<float>(2 * std::asin(std::sqrt(0.5 * versine)));
}

float theta_rad(CurveAngle angle, const Imath::V3f& wi, const Imath::V3f& wo) {
    switch (angle) {
        case CurveAngle::half:
            return polar_angle(wi + wo);
        case CurveAngle::difference:
            return half_angle_between(wi, wo);
        case CurveAngle::incidence:
            return polar_angle(wi);
        case CurveAngle::viewing:
            return polar_angle(wo);
        case CurveAngle::reflection:
            return 2 * half_angle_between(wi, {-wo.x, -wo.y, wo.z});
        case CurveAngle::along_u:
        case CurveAngle::along_v:
            break;
    }
    const Imath::V3f half = wi + wo;
    const float sin2 = half.x * half.x + half.y * half.y;
    const float along = angle == CurveAngle::along_u ? half.x : half.y;
    return sin2 > 0 ? spread_angle(sin2, half.z, along * along / sin2) : 0.0F;
}

}  // namespace

float u_from_directions(CurveAngle angle, const Imath::V3f& wi, const Imath::V3f& wo) {
    const float part = std::clamp(theta_rad(angle, wi, wo) / kHalfPi, 0.0F, 1.0F);
    return has_root_mapping(angle) ? std::sqrt(part) : part;
}

double degrees_from_u(CurveAngle angle, double u) {
    return 90 * (has_root_mapping(angle) ? u * u : u);
}

double u_from_degrees(CurveAngle angle, double degrees) {
    return has_root_mapping(angle) ? std::sqrt(degrees / 90) : degrees / 90;
}

bool has_root_mapping(CurveAngle angle) {
    switch (angle) {
        case CurveAngle::half:
        case CurveAngle::reflection:
        case CurveAngle::along_u:
        case CurveAngle::along_v:
            return true;
        case CurveAngle::difference:
        case CurveAngle::incidence:
        case CurveAngle::viewing:
            break;
    }
    return false;
}

}  // namespace relume::curve
