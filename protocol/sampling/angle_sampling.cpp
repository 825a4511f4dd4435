#include "protocol/sampling/angle_sampling.h"

#include "protocol/brdf/local_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::sampling {
namespace {

constexpr float kTwoPi = 2 * std::numbers::pi_v<float>;
constexpr float kRightAngle = std::numbers::pi_v<float> / 2;
constexpr float kLeastAngle = 1e-6F;  // below it the density passes what a float holds well

// Around the z axis, per steradian, of an angle in [0, 90°].
float axis_pdf(float angle) {
    const float theta = std::max(angle, kLeastAngle);
    return 1 / (2 * std::sqrt(theta * kRightAngle) * kTwoPi * std::sin(theta));
}

// Well-conditioned for any angle, unlike the inverse cosine.
float angle_between(const Imath::V3f& a, const Imath::V3f& b) {
    return std::atan2(a.cross(b).length(), a.dot(b));
}

Imath::V3f mirrored(const Imath::V3f& wo) {
    return {-wo.x, -wo.y, wo.z};
}

}  // namespace

AngleSample sample_angle(SampledAngle angle, const Imath::V3f& wo, const Imath::V2f& u) {
    const float theta = std::max(u.x * u.x * kRightAngle, kLeastAngle);
    const float phi = kTwoPi * u.y;
    const float sine = std::sin(theta);
    const Imath::V3f around(sine * std::cos(phi), sine * std::sin(phi), std::cos(theta));
    AngleSample sample;
    if (angle == SampledAngle::half) {
        const float cosine = wo.dot(around);
        if (cosine <= 0) {
            return sample;
        }
        sample.wi = (around * (2 * cosine) - wo).normalized();
    } else {
        sample.wi = brdf::local_frame(mirrored(wo)).world_from_local(around).normalized();
    }
    sample.pdf = sample.wi.z > 0 ? angle_pdf(angle, sample.wi, wo) : 0.0F;
    return sample;
}

float angle_pdf(SampledAngle angle, const Imath::V3f& wi, const Imath::V3f& wo) {
    if (angle == SampledAngle::reflection) {
        const float theta = angle_between(wi, mirrored(wo));
        return theta <= kRightAngle ? axis_pdf(theta) : 0.0F;
    }
    const Imath::V3f half = (wi + wo).normalized();
    const float cosine = wo.dot(half);
    return cosine > 0 ? axis_pdf(std::atan2(std::hypot(half.x, half.y), half.z)) / (4 * cosine)
                      : 0.0F;
}

}  // namespace relume::sampling
