#include "protocol/curve/curve_shape.h"

#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

namespace relume::curve {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr std::array kBeckmann{Parameter{"sigma", false, 0.001, 2, 0.2}};
constexpr std::array kGgx{Parameter{"alpha", false, 0.001, 1, 0.1}};
constexpr std::array kVelvet{Parameter{"sigma", false, 0.05, 2, 0.4}};
constexpr std::array kConductor{Parameter{"n", true, 0.01, 10, 1},
                                Parameter{"e", true, 0, 20, 5}};
constexpr std::array kDielectric{Parameter{"n", false, 1, 4, 1.5}};
constexpr std::array kSchlick{Parameter{"f0", true, 0, 1, 0.04},
                              Parameter{"f90", false, 0, 1, 1}};
constexpr std::array kCosinePower{Parameter{"exponent", false, 0, 1e5, 50}};
constexpr std::array kConstant{
    Parameter{"value", true, 0, static_cast<double>(kMostCurveValue), 1}};

double squared(double x) {
    return x * x;
}

double beckmann(double theta, double sigma) {
    const double cos2 = squared(std::cos(theta));
    // At the horizon exp wins over the power of the cosine.
    return cos2 > 1e-12
               ? std::exp(-squared(std::tan(theta) / sigma)) / (kPi * squared(sigma * cos2))
               : 0.0;
}

double ggx(double theta, double alpha) {
    return squared(alpha) /
           (kPi * squared(squared(alpha * std::cos(theta)) + squared(std::sin(theta))));
}

double velvet(double theta, double sigma) {
    const double sin2 = squared(std::sin(theta));
    // At the normal exp wins over the power of the sine.
    const double rim = sin2 > 1e-12
                           ? 4 * std::exp(-(1 - sin2) / (sin2 * squared(sigma))) / squared(sin2)
                           : 0.0;
    return (1 + rim) / (kPi * (1 + 4 * squared(sigma)));
}

double schlick(double theta, double f0, double f90) {
    return f0 + (f90 - f0) * std::pow(1 - std::cos(theta), 5);
}

double cosine_power_scale(CurveAngle angle, double exponent) {
    switch (angle) {
        case CurveAngle::half:
        case CurveAngle::reflection:
            return (exponent + 2) / (2 * kPi);
        case CurveAngle::along_u:
        case CurveAngle::along_v:
            return std::sqrt(exponent + 1);
        case CurveAngle::difference:
        case CurveAngle::incidence:
        case CurveAngle::viewing:
            break;
    }
    return 1;
}

// cosᵖθ, by the logarithm so that large powers keep their digits near the normal.
double cosine_power(double theta, double exponent) {
    const double cosine = std::cos(theta);
    if (cosine <= 1e-12) {
        return exponent == 0 ? 1.0 : 0.0;
    }
    return std::exp(0.5 * exponent * std::log1p(-squared(std::sin(theta))));
}

double value_of(CurveShape shape,
                CurveAngle angle,
                double theta,
                std::span<const Imath::V3d> values,
                int c) {
    switch (shape) {
        case CurveShape::beckmann:
            return beckmann(theta, values[0][c]);
        case CurveShape::ggx:
            return ggx(theta, values[0][c]);
        case CurveShape::velvet:
            return velvet(theta, values[0][c]);
        case CurveShape::conductor:
            return fresnel_reflectance(std::cos(theta), values[0][c], values[1][c]);
        case CurveShape::dielectric:
            return fresnel_reflectance(std::cos(theta), values[0][c], 0);
        case CurveShape::schlick:
            return schlick(theta, values[0][c], values[1][c]);
        case CurveShape::cosine_power:
            return cosine_power_scale(angle, values[0][c]) * cosine_power(theta, values[0][c]);
        case CurveShape::constant:
            break;
    }
    return values[0][c];
}

}  // namespace

double fresnel_reflectance(double cosine, double n, double e) {
    // The index squared, and the index times the cosine within.
    const std::complex<double> index2 = std::complex<double>(n, e) * std::complex<double>(n, e);
    const std::complex<double> within = std::sqrt(index2 - 1.0 + squared(cosine));
    if (within == -cosine) {
        return 0;  // index 1 at the horizon: there is no boundary
    }
    const auto across = (cosine - within) / (cosine + within);
    const auto along = (index2 * cosine - within) / (index2 * cosine + within);
    return std::min(1.0, 0.5 * (std::norm(across) + std::norm(along)));
}

std::span<const Parameter> parameters_of(CurveShape shape) {
    switch (shape) {
        case CurveShape::beckmann:
            return kBeckmann;
        case CurveShape::ggx:
            return kGgx;
        case CurveShape::velvet:
            return kVelvet;
        case CurveShape::conductor:
            return kConductor;
        case CurveShape::dielectric:
            return kDielectric;
        case CurveShape::schlick:
            return kSchlick;
        case CurveShape::cosine_power:
            return kCosinePower;
        case CurveShape::constant:
            break;
    }
    return kConstant;
}

CurveShape shape_from_name(std::string_view name) {
    if (const auto shape = kCurveShapeNames.value(name)) {
        return *shape;
    }
    const auto words = kCurveShapeNames.words();
    const std::vector<std::string> known(words.begin(), words.end());
    throw CurveError(fmt::format("shape of a curve: found {}, expected a shape: {}", name,
                                 text::expected_name(name, known, "shapes")));
}

Curve curve_from_shape(CurveShape shape, CurveAngle angle, std::span<const Imath::V3d> values) {
    require_in_range(parameters_of(shape), values, kCurveShapeNames.name(shape));
    return curve_from_function([&](double u) {
        const double theta = degrees_from_u(angle, u) * kPi / 180;
        return Imath::V3d(value_of(shape, angle, theta, values, 0),
                          value_of(shape, angle, theta, values, 1),
                          value_of(shape, angle, theta, values, 2));
    });
}

Curve ShapedCurve::curve(CurveAngle angle) const {
    return curve_from_shape(shape, angle, values);
}

}  // namespace relume::curve
