#include "precompute/factors/curve_factors.h"

#include "precompute/factors/curve_product.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace relume::factors {
namespace {

using curve::CurveAngle;

constexpr std::size_t kFitSamples = 1U << 16;
constexpr std::size_t kErrorSamples = 1U << 18;
constexpr double kFitShift = 0.5;
constexpr double kErrorShift = 0.137;

// One colour as it is fitted.
struct ColourFit {
    double diffuse = 0;  // ρ is this and the product
    CurveColumns columns;
    double error = 0;
};
using ColourFits = std::array<ColourFit, 3>;

curve::CurveBrdf brdf_from_columns(const ColourFits& colours) {
    std::array<curve::Curve, kFittedCurves> curves;
    for (std::size_t column = 0; column < curves.size(); ++column) {
        for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                curves[column].rgb[c][k] = static_cast<float>(colours[c].columns(
                    static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(column)));
            }
        }
    }
    return curve::CurveBrdf::measured({{CurveAngle::half, curves[0]},
                                       {CurveAngle::difference, curves[1]},
                                       {CurveAngle::incidence, curves[2]},
                                       {CurveAngle::viewing, curves[2]}});
}

std::size_t count_floored(const CurveFitSamples& samples) {
    const Imath::V3d floor = samples.floor();
    std::size_t count = 0;
    for (const CurveFitSample& sample : samples.samples) {
        for (int c = 0; c < 3; ++c) {
            count += sample.value[c] < floor[c] ? 1U : 0U;
        }
    }
    return count;
}

// Errors of the fitted against the true values as they add up.
class ErrorSum {
  public:
    void add(const CurveFitSample& sample, double fitted, double value, double floor) {
        error_ += sample.solid_angle * std::pow(fitted - value, 2);
        norm_ += sample.solid_angle * std::pow(value, 2);
        if (floor > 0) {  // else the colour is black everywhere
            logarithms_ +=
                sample.solid_angle * std::pow(std::log((fitted + floor) / (value + floor)), 2);
            weights_ += sample.solid_angle;
        }
    }
    [[nodiscard]] CurveErrors errors() const {
        return {norm_ > 0 ? std::sqrt(error_ / norm_) : 0.0,
                weights_ > 0 ? std::sqrt(logarithms_ / weights_) : 0.0};
    }

  private:
    double error_ = 0;
    double norm_ = 0;
    double logarithms_ = 0;
    double weights_ = 0;
};

// The relative L2 error and the logarithmic one together.
double error_of(const CurveFitSamples& samples, int colour, const ColourFit& fit) {
    const double floor = samples.floor()[colour];
    ErrorSum sum;
    for (const CurveFitSample& sample : samples.samples) {
        const std::array<double, 4> f = factors_at(fit.columns, sample);
        sum.add(sample, fit.diffuse + f[0] * f[1] * f[2] * f[3], sample.value[colour], floor);
    }
    const CurveErrors errors = sum.errors();
    return errors.relative_l2 + errors.logarithmic;
}

ColourFit fit_of(const CurveFitSamples& samples, int colour, double part, CurveMethod method) {
    ColourFit fit;
    const double quantile = part > 0 ? samples.quantile(colour, part) : 0.0;
    fit.diffuse = quantile > samples.floor()[colour] ? quantile : 0.0;
    fit.columns = homomorphic_columns(samples, colour, fit.diffuse);
    if (method == CurveMethod::nonnegative) {
        improve_nonnegative(samples, colour, fit.diffuse, fit.columns);
    }
    fit.error = error_of(samples, colour, fit);
    return fit;
}

// Tries how much to leave to the diffuse colour, the same part for all colours, so that hues
// stay what they are.
ColourFits best_fits(const CurveFitSamples& samples, CurveMethod method) {
    constexpr std::array kParts{0.0, 0.1, 0.3, 0.5};
    std::array<ColourFits, kParts.size()> all;
    tbb::parallel_for(std::size_t{0}, 3 * kParts.size(), [&](std::size_t i) {
        const std::size_t c = i % 3;
        all[i / 3][c] = fit_of(samples, static_cast<int>(c), kParts[i / 3], method);
    });
    const auto error = [](const ColourFits& fits) {
        return fits[0].error + fits[1].error + fits[2].error;
    };
    return *std::min_element(
        all.begin(), all.end(),
        [&](const ColourFits& a, const ColourFits& b) { return error(a) < error(b); });
}

}  // namespace

CurveFactorisation factorise_curves(const BrdfLobes& lobes, CurveMethod method) {
    const CurveFitSamples samples = curve_fit_samples(lobes, kFitSamples, kFitShift);
    const ColourFits colours = best_fits(samples, method);
    Imath::V3f diffuse;
    for (std::size_t c = 0; c < 3; ++c) {
        diffuse[static_cast<int>(c)] =
            static_cast<float>(colours[c].diffuse * std::numbers::pi);
    }
    curve::CurveBrdf brdf = brdf_from_columns(colours);
    const CurveErrors errors = curve_errors(diffuse, brdf, lobes);
    return {.diffuse = diffuse,
            .brdf = std::move(brdf),
            .errors = errors,
            .value_count = 3 * samples.samples.size(),
            .negative_count = samples.negative_count,
            .floored_count = count_floored(samples),
            .unmeasured_count = 0};
}

CurveFactorisation factorise_curves(const MerlBrdf& measured, CurveMethod method) {
    CurveFactorisation factorisation = factorise_curves(lobes_of(measured), method);
    factorisation.unmeasured_count = measured.unmeasured_count();
    return factorisation;
}

CurveErrors curve_errors(const Imath::V3f& diffuse,
                         const curve::CurveBrdf& brdf,
                         const BrdfLobes& lobes) {
    const CurveFitSamples samples = curve_fit_samples(lobes, kErrorSamples, kErrorShift);
    const Imath::V3d floor = samples.floor();
    ErrorSum sum;
    for (const CurveFitSample& sample : samples.samples) {
        if (std::min(sample.wi.z, sample.wo.z) < kLeastJudgedCosine) {
            continue;
        }
        const Imath::V3d fitted(diffuse * std::numbers::inv_pi_v<float> +
                                brdf.evaluate(sample.wi, sample.wo));
        for (int c = 0; c < 3; ++c) {
            sum.add(sample, fitted[c], sample.value[c], floor[c]);
        }
    }
    return sum.errors();
}

}  // namespace relume::factors
