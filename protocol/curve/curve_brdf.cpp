#include "protocol/curve/curve_brdf.h"

#include "protocol/base/text/near_names.h"
#include "protocol/curve/curve_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace relume::curve {
namespace {

constexpr float kLeastCosine = 1e-4F;

constexpr std::array kGgx{Parameter{"f0", true, 0, 1, 0.04}, Parameter{"f90", false, 0, 1, 1},
                          Parameter{"alpha", false, 0.001, 1, 0.1}};
constexpr std::array kCookTorrance{Parameter{"sigma", false, 0.001, 2, 0.2},
                                   Parameter{"n", true, 0.01, 10, 1.5},
                                   Parameter{"e", true, 0, 20, 0}};
constexpr std::array kAshikhminShirley{Parameter{"rs", true, 0, 1, 0.04},
                                       Parameter{"nu", false, 0, 1e5, 50},
                                       Parameter{"nv", false, 0, 1e5, 50}};
constexpr std::array kPhong{Parameter{"ks", true, 0, 1, 0.5},
                            Parameter{"exponent", false, 0, 1e5, 50}};

float bounded(float cosine) {
    return std::max(cosine, kLeastCosine);
}

float smith_rest(float alpha, const Imath::V3f& wi, const Imath::V3f& wo) {
    const float alpha2 = alpha * alpha;
    const float cos_i = bounded(wi.z);
    const float cos_o = bounded(wo.z);
    const auto root = [&](float cosine) {
        return std::sqrt(cosine * cosine * (1 - alpha2) + alpha2);
    };
    return 0.5F / (cos_i * root(cos_o) + cos_o * root(cos_i));
}

// cos θ_d, without the cancellation of 1 + ωi·ωo.
float difference_cosine(const Imath::V3f& wi, const Imath::V3f& wo) {
    return bounded(0.5F * (wi + wo).length());
}

float grooves_rest(const Imath::V3f& wi, const Imath::V3f& wo) {
    const float cos_i = bounded(wi.z);
    const float cos_o = bounded(wo.z);
    const float cos_d = difference_cosine(wi, wo);
    const float cos_h = std::min(1.0F, 0.5F * (cos_i + cos_o) / cos_d);
    const float shadowing = std::min(1.0F, 2 * cos_h * std::min(cos_i, cos_o) / cos_d);
    return shadowing / (4 * cos_i * cos_o);
}

float ashikhmin_shirley_rest(const Imath::V3f& wi, const Imath::V3f& wo) {
    return std::numbers::inv_pi_v<float> /
           (8 * difference_cosine(wi, wo) * bounded(std::max(wi.z, wo.z)));
}

Imath::V3d grey(float value) {
    return Imath::V3d(static_cast<double>(value));
}

std::vector<BrdfCurve> curves_from_parameters(CurveModel model, const ParameterValues& p) {
    const auto shaped = [](CurveAngle angle, CurveShape shape, const ParameterValues& values) {
        return BrdfCurve{angle, curve_from_shape(shape, angle, values)};
    };
    switch (model) {
        case CurveModel::ggx:
            return {shaped(CurveAngle::half, CurveShape::ggx, {p[2]}),
                    shaped(CurveAngle::difference, CurveShape::schlick, {p[0], p[1]})};
        case CurveModel::cook_torrance:
            return {shaped(CurveAngle::half, CurveShape::beckmann, {p[0]}),
                    shaped(CurveAngle::difference, CurveShape::conductor, {p[1], p[2]})};
        case CurveModel::ashikhmin_shirley:
            return {shaped(CurveAngle::along_u, CurveShape::cosine_power, {p[1]}),
                    shaped(CurveAngle::along_v, CurveShape::cosine_power, {p[2]}),
                    shaped(CurveAngle::difference, CurveShape::schlick, {p[0], Imath::V3d(1)})};
        case CurveModel::phong: {
            BrdfCurve lobe = shaped(CurveAngle::reflection, CurveShape::cosine_power, {p[1]});
            lobe.curve = tinted(lobe.curve, Imath::V3f(p[0]));
            return {lobe};
        }
        case CurveModel::measured:
            break;
    }
    throw CurveError("measured curves have no parameters; expected their samples");
}

std::string text_of_curve(const BrdfCurve& curve) {
    return fmt::format("curve {}", curve.name());
}

}  // namespace

std::span<const Parameter> parameters_of(CurveModel model) {
    switch (model) {
        case CurveModel::ggx:
            return kGgx;
        case CurveModel::cook_torrance:
            return kCookTorrance;
        case CurveModel::ashikhmin_shirley:
            return kAshikhminShirley;
        case CurveModel::phong:
            return kPhong;
        case CurveModel::measured:
            break;
    }
    return {};
}

CurveBrdf CurveBrdf::ggx(const Imath::V3f& f0, float f90, float alpha) {
    return from_parameters(CurveModel::ggx, {Imath::V3d(f0), grey(f90), grey(alpha)});
}

CurveBrdf CurveBrdf::cook_torrance(float sigma, const Imath::V3f& n, const Imath::V3f& e) {
    return from_parameters(CurveModel::cook_torrance,
                           {grey(sigma), Imath::V3d(n), Imath::V3d(e)});
}

CurveBrdf CurveBrdf::ashikhmin_shirley(const Imath::V3f& rs, float nu, float nv) {
    return from_parameters(CurveModel::ashikhmin_shirley, {Imath::V3d(rs), grey(nu), grey(nv)});
}

CurveBrdf CurveBrdf::phong(const Imath::V3f& ks, float exponent) {
    return from_parameters(CurveModel::phong, {Imath::V3d(ks), grey(exponent)});
}

CurveBrdf CurveBrdf::from_parameters(CurveModel model, ParameterValues values) {
    require_in_range(parameters_of(model), values, kCurveModelNames.name(model));
    CurveBrdf brdf;
    brdf.model_ = model;
    brdf.curves_ = curves_from_parameters(model, values);
    brdf.parameters_ = std::move(values);
    brdf.is_replaced_.assign(brdf.curves_.size(), false);
    return brdf;
}

CurveBrdf CurveBrdf::measured(std::vector<BrdfCurve> curves) {
    if (curves.empty() || curves.size() > kMostMeasuredCurves) {
        throw CurveError(fmt::format("measured BRDF: found {} curves, expected 1 … {}",
                                     curves.size(), kMostMeasuredCurves));
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
        require_valid(curves[i].curve, text_of_curve(curves[i]));
        for (std::size_t j = 0; j < i; ++j) {
            if (curves[j].angle == curves[i].angle) {
                throw CurveError(fmt::format("measured BRDF: found {} twice, expected once",
                                             text_of_curve(curves[i])));
            }
        }
    }
    std::sort(curves.begin(), curves.end(),
              [](const BrdfCurve& a, const BrdfCurve& b) { return a.angle < b.angle; });
    CurveBrdf brdf;
    brdf.model_ = CurveModel::measured;
    brdf.is_replaced_.assign(curves.size(), true);
    brdf.curves_ = std::move(curves);
    return brdf;
}

std::optional<std::size_t> CurveBrdf::index_of(CurveAngle angle) const {
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (curves_[i].angle == angle) {
            return i;
        }
    }
    return std::nullopt;
}

std::size_t CurveBrdf::index_of(std::string_view curve_name) const {
    std::vector<std::string> known;
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (curves_[i].name() == curve_name) {
            return i;
        }
        known.emplace_back(curves_[i].name());
    }
    throw CurveError(fmt::format("curve of {}: found {}, expected a curve it has: {}",
                                 kCurveModelNames.name(model_), curve_name,
                                 text::expected_name(curve_name, known, "curves")));
}

CurveBrdf CurveBrdf::with_curve(std::size_t index, const Curve& curve) const {
    CurveBrdf brdf = *this;
    require_valid(curve, text_of_curve(curves_.at(index)));
    brdf.curves_[index].curve = curve;
    brdf.is_replaced_[index] = true;
    return brdf;
}

bool CurveBrdf::is_of_parameters(std::size_t index) const {
    return !is_replaced_.at(index);
}

Imath::V3f CurveBrdf::evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const {
    return product(curves_.size(), wi, wo);
}

Imath::V3f CurveBrdf::quotient(std::size_t index,
                               const Imath::V3f& wi,
                               const Imath::V3f& wo) const {
    return product(index, wi, wo);
}

float CurveBrdf::rest(const Imath::V3f& wi, const Imath::V3f& wo) const {
    if (!(wi.z > 0 && wo.z > 0)) {
        return 0;
    }
    switch (model_) {
        case CurveModel::ggx:
            return smith_rest(static_cast<float>(parameters_[2].x), wi, wo);
        case CurveModel::cook_torrance:
            return grooves_rest(wi, wo);
        case CurveModel::ashikhmin_shirley:
            return ashikhmin_shirley_rest(wi, wo);
        case CurveModel::phong:
        case CurveModel::measured:
            break;
    }
    return 1;
}

Imath::V3f CurveBrdf::product(std::size_t without,
                              const Imath::V3f& wi,
                              const Imath::V3f& wo) const {
    Imath::V3f value(rest(wi, wo));
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        if (i != without && value.x + value.y + value.z > 0) {
            value *= curves_[i].curve.at(u_from_directions(curves_[i].angle, wi, wo));
        }
    }
    return value;
}

}  // namespace relume::curve
