#include "protocol/curve/curve_shape.h"

#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace relume::curve {
namespace {

constexpr double kPi = std::numbers::pi;

Curve shaped(CurveShape shape, double value, CurveAngle angle = CurveAngle::half) {
    const Imath::V3d values[]{Imath::V3d(value)};
    return curve_from_shape(shape, angle, values);
}

// 2π ∫ c(θ)·cosᵖ(θ) sin θ dθ of the curve as it is between its samples.
double integral(const Curve& curve, CurveAngle angle, double power) {
    constexpr int kSteps = 200000;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double u = (i + 0.5) / kSteps;
        const double theta = degrees_from_u(angle, u) * kPi / 180;
        const double slope = has_root_mapping(angle) ? kPi * u : kPi / 2;  // dθ/du
        sum += curve.at(static_cast<float>(u)).x * std::pow(std::cos(theta), power) *
               std::sin(theta) * slope / kSteps;
    }
    return 2 * kPi * sum;
}

TEST(CurveShape, DistributionsIntegrateToOne) {
    for (const double sigma : {0.01, 0.05, 0.2, 0.5, 1.0}) {
        EXPECT_NEAR(integral(shaped(CurveShape::beckmann, sigma), CurveAngle::half, 1), 1, 4e-3)
            << sigma;
    }
    for (const double alpha : {0.005, 0.01, 0.1, 0.5, 1.0}) {
        EXPECT_NEAR(integral(shaped(CurveShape::ggx, alpha), CurveAngle::half, 1), 1, 4e-3)
            << alpha;
    }
    for (const double sigma : {0.05, 0.2, 0.5, 1.0, 2.0}) {
        EXPECT_NEAR(integral(shaped(CurveShape::velvet, sigma), CurveAngle::half, 1), 1, 4e-3)
            << sigma;
    }
    for (const double exponent : {0.0, 1.0, 30.0, 1e4}) {
        EXPECT_NEAR(integral(shaped(CurveShape::cosine_power, exponent), CurveAngle::half, 1),
                    1, 2e-3);
        // Phong's lobe straight on reflects all.
        const Curve lobe = shaped(CurveShape::cosine_power, exponent, CurveAngle::reflection);
        EXPECT_NEAR(integral(lobe, CurveAngle::reflection, 1), 1, 2e-3);
    }
}

TEST(CurveShape, ValuesAreTheFormulas) {
    const auto at = [](const Curve& curve, double degrees) {
        return curve.at(static_cast<float>(u_from_degrees(CurveAngle::half, degrees))).x;
    };
    EXPECT_NEAR(at(shaped(CurveShape::beckmann, 0.3), 0), 1 / (kPi * 0.09), 1e-5);
    EXPECT_NEAR(at(shaped(CurveShape::beckmann, 0.3), 20),
                std::exp(-std::pow(std::tan(kPi / 9) / 0.3, 2)) /
                    (kPi * 0.09 * std::pow(std::cos(kPi / 9), 4)),
                1e-3);
    EXPECT_NEAR(at(shaped(CurveShape::ggx, 0.2), 0), 1 / (kPi * 0.04), 1e-5);
    EXPECT_NEAR(at(shaped(CurveShape::ggx, 0.2), 90), 0.04 / kPi, 1e-7);
    EXPECT_NEAR(at(shaped(CurveShape::velvet, 0.5), 0), 1 / (2 * kPi), 1e-6);
    EXPECT_NEAR(at(shaped(CurveShape::velvet, 0.5), 90), 5 / (2 * kPi), 1e-6);
    EXPECT_NEAR(at(shaped(CurveShape::cosine_power, 20), 0), 22 / (2 * kPi), 1e-5);
    EXPECT_EQ(at(shaped(CurveShape::cosine_power, 20), 90), 0);
    EXPECT_EQ(at(shaped(CurveShape::constant, 0.7), 33), 0.7F);
    EXPECT_NEAR(shaped(CurveShape::cosine_power, 3, CurveAngle::along_v).at(0.0F).x, 2, 1e-6);
    EXPECT_NEAR(shaped(CurveShape::cosine_power, 3, CurveAngle::viewing).at(0.0F).x, 1, 1e-6);
    const Imath::V3d schlick[]{{0.1, 0.2, 0.3}, Imath::V3d(0.8)};
    const Curve curve = curve_from_shape(CurveShape::schlick, CurveAngle::difference, schlick);
    EXPECT_NEAR((curve.at(0.0F) - Imath::V3f(0.1F, 0.2F, 0.3F)).length(), 0, 1e-6F);
    EXPECT_NEAR((curve.at(1.0F) - Imath::V3f(0.8F)).length(), 0, 1e-6F);
    EXPECT_NEAR(curve.at(2.0F / 3).x, 0.1 + 0.7 / 32, 1e-4);  // cos 60° = ½
}

// Fresnel by the textbook's real formulas for a metal: 2p² = √(A² + 4n²k²) + A, A = n² − k² −
// sin².
double textbook_conductor(double cosine, double n, double k) {
    const double sin2 = 1 - cosine * cosine;
    const double a = n * n - k * k - sin2;
    const double both = std::sqrt(a * a + 4 * n * n * k * k);
    const double p = std::sqrt(std::max(0.0, (both + a) / 2));
    const double across =
        (both + cosine * cosine - 2 * p * cosine) / (both + cosine * cosine + 2 * p * cosine);
    const double along = across *
                         (cosine * cosine * both + sin2 * sin2 - 2 * p * cosine * sin2) /
                         (cosine * cosine * both + sin2 * sin2 + 2 * p * cosine * sin2);
    return 0.5 * (across + along);
}

TEST(CurveShape, ConductorsReflectAsFresnelSays) {
    for (const double n : {0.05, 0.2, 1.0, 1.5, 4.0}) {
        for (const double e : {0.0, 0.5, 3.0, 9.0}) {
            for (double cosine = 0; cosine <= 1; cosine += 0.01) {
                if (e == 0 && n <= 1) {
                    continue;  // total reflection, or no boundary: 0/0 in the textbook
                }
                ASSERT_NEAR(fresnel_reflectance(cosine, n, e), textbook_conductor(cosine, n, e),
                            1e-9)
                    << n << " " << e << " " << cosine;
            }
            EXPECT_NEAR(fresnel_reflectance(1e-9, n, e), e == 0 && n == 1 ? 0 : 1, 1e-6);
            const std::complex<double> r =
                (std::complex<double>(n, e) - 1.0) / (std::complex<double>(n, e) + 1.0);
            EXPECT_NEAR(fresnel_reflectance(1, n, e), std::norm(r), 1e-12);
        }
    }
    // Glass at Brewster's angle reflects across alone; total reflection from within.
    const double brewster = std::cos(std::atan(1.5));
    const double across = (1 - 2.25) / (1 + 2.25);
    EXPECT_NEAR(fresnel_reflectance(brewster, 1.5, 0), 0.5 * across * across, 1e-9);
    EXPECT_NEAR(fresnel_reflectance(0.3, 1 / 1.5, 0), 1, 1e-9);
    const Curve glass = shaped(CurveShape::dielectric, 1.5, CurveAngle::difference);
    EXPECT_NEAR(glass.at(0.0F).x, 0.04, 1e-6);
    EXPECT_NEAR(glass.at(1.0F).x, 1, 1e-6);
}

TEST(CurveShape, EveryShapeIsValidOverItsWholeRangeAndEveryAngle) {
    for (const auto& word : kCurveShapeNames.words()) {
        const CurveShape shape = shape_from_name(word);
        const auto parameters = parameters_of(shape);
        for (int corner = 0; corner < (1 << parameters.size()); ++corner) {
            ParameterValues values;
            for (std::size_t i = 0; i < parameters.size(); ++i) {
                values.emplace_back((corner >> i & 1) != 0 ? parameters[i].highest
                                                           : parameters[i].lowest);
            }
            for (const auto& angle : kCurveAngleNames.words()) {
                EXPECT_NO_THROW(require_valid(
                    curve_from_shape(shape, *kCurveAngleNames.value(angle), values), word));
            }
        }
        EXPECT_NO_THROW(require_in_range(parameters, usual_values(parameters), word));
    }
}

TEST(CurveShape, RefusesBadParameters) {
    const auto make = [](CurveShape shape, ParameterValues values) {
        return [shape, values] {
            static_cast<void>(curve_from_shape(shape, CurveAngle::half, values));
        };
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_curve_error(make(CurveShape::ggx, {Imath::V3d(0)}), "ggx: found 0 for alpha");
    expect_curve_error(make(CurveShape::ggx, {Imath::V3d(nan)}), "found nan for alpha");
    expect_curve_error(make(CurveShape::beckmann, {Imath::V3d(-0.1)}), "for sigma");
    expect_curve_error(make(CurveShape::cosine_power, {Imath::V3d(1e30)}), "1e+30");
    expect_curve_error(make(CurveShape::ggx, {{0.1, 0.2, 0.1}}), "three values for alpha");
    expect_curve_error(make(CurveShape::conductor, {Imath::V3d(1)}),
                       "found 1 parameters, expected 2");
    expect_curve_error([] { static_cast<void>(shape_from_name("bekmann")); },
                       "did you mean beckmann");
    expect_curve_error([] { static_cast<void>(shape_from_name("")); }, "shape of a curve");
}

}  // namespace
}  // namespace relume::curve
