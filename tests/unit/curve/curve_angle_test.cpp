#include "protocol/curve/curve_angle.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::curve {
namespace {

using Imath::V3d;
using Imath::V3f;

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

double angle_between(const V3d& a, const V3d& b) {
    return degrees(std::atan2(a.cross(b).length(), a.dot(b)));
}

// The definitions, word for word.
double expected_degrees(CurveAngle angle, const V3f& light, const V3f& view) {
    const V3d wi(light);
    const V3d wo(view);
    const V3d normal(0, 0, 1);
    const V3d half = (wi + wo).normalized();
    const double phi = std::atan2(half.y, half.x);
    switch (angle) {
        case CurveAngle::half:
            return angle_between(half, normal);
        case CurveAngle::difference:
            return angle_between(wi, half);
        case CurveAngle::incidence:
            return angle_between(wi, normal);
        case CurveAngle::viewing:
            return angle_between(wo, normal);
        case CurveAngle::reflection:
            return std::min(90.0, angle_between(wi, {-wo.x, -wo.y, wo.z}));
        case CurveAngle::along_u:
            return degrees(std::acos(std::pow(half.z, std::pow(std::cos(phi), 2))));
        case CurveAngle::along_v:
            break;
    }
    return degrees(std::acos(std::pow(half.z, std::pow(std::sin(phi), 2))));
}

TEST(CurveAngle, IsWhatItsDefinitionSays) {
    HemisphereDirections directions(1);
    for (int i = 0; i < 5000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        for (const auto& word : kCurveAngleNames.words()) {
            const CurveAngle angle = *kCurveAngleNames.value(word);
            const double expected = expected_degrees(angle, wi, wo);
            const double u = u_from_directions(angle, wi, wo);
            ASSERT_NEAR(degrees_from_u(angle, u), expected, 2e-4) << word;
        }
    }
}

TEST(CurveAngle, KeepsItsDigitsInASharpHighlight) {
    const V3f wo = direction_from_degrees(40, 20);
    for (const double off : {0.01, 0.02, 0.1, 1.0}) {
        const V3f wi = direction_from_degrees(40 + off, 200);
        EXPECT_NEAR(
            degrees_from_u(CurveAngle::half, u_from_directions(CurveAngle::half, wi, wo)),
            off / 2, 1e-5);
        EXPECT_NEAR(degrees_from_u(CurveAngle::reflection,
                                   u_from_directions(CurveAngle::reflection, wi, wo)),
                    off, 2e-5);
    }
}

TEST(CurveAngle, USpansItsRange) {
    for (const auto& word : kCurveAngleNames.words()) {
        const CurveAngle angle = *kCurveAngleNames.value(word);
        EXPECT_EQ(degrees_from_u(angle, 0), 0);
        EXPECT_EQ(degrees_from_u(angle, 1), 90);
        for (double u = 0; u <= 1; u += 1.0 / 64) {
            EXPECT_NEAR(u_from_degrees(angle, degrees_from_u(angle, u)), u, 1e-15);
        }
        EXPECT_NEAR(u_from_degrees(angle, 22.5), has_root_mapping(angle) ? 0.5 : 0.25, 1e-15);
    }
}

TEST(CurveAngle, IsFiniteAtTheEdges) {
    const double edges[]{0, 1e-5, 45, 89.99999};
    for (const double i : edges) {
        for (const double o : edges) {
            for (const double phi : {0.0, 90.0, 180.0, 180.00001}) {
                V3f wi = direction_from_degrees(i, 0);
                V3f wo = direction_from_degrees(o, phi);
                for (const auto& word : kCurveAngleNames.words()) {
                    const float u = u_from_directions(*kCurveAngleNames.value(word), wi, wo);
                    EXPECT_TRUE(u >= 0 && u <= 1) << word << " " << u;
                }
            }
        }
    }
}

TEST(CurveAngle, BothSpreadsTogetherAreTheHalfAngle) {
    // cos θ_u · cos θ_v = cos θ_h, as cos² + sin² = 1.
    HemisphereDirections directions(3);
    for (int i = 0; i < 1000; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        const auto cosine = [&](CurveAngle angle) {
            return std::cos(degrees_from_u(angle, u_from_directions(angle, wi, wo)) *
                            std::numbers::pi / 180);
        };
        EXPECT_NEAR(cosine(CurveAngle::along_u) * cosine(CurveAngle::along_v),
                    cosine(CurveAngle::half), 1e-5);
    }
}

}  // namespace
}  // namespace relume::curve
