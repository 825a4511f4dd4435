#include "precompute/bake/curves/curve_signals.h"

#include "protocol/basis/curve_projection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace relume::bake {
namespace {

using curve::Curve;
using curve::kCurveSamples;

constexpr std::size_t kColumnsOfCurve = 1 + kCurveSamples;

template <typename Value>
Curve grey_curve(Value value) {
    Curve curve;
    for (std::size_t k = 0; k < kCurveSamples; ++k) {
        curve.set_sample(k, Imath::V3f(value(k)));
    }
    return curve;
}

Curve grey(const Curve& of) {
    return grey_curve([&](std::size_t k) {
        const Imath::V3f value = of.sample(k);
        return (value.x + value.y + value.z) / 3;
    });
}

// The curve over u · factor.
Curve stretched(const Curve& of, float factor) {
    return grey_curve(
        [&](std::size_t k) { return of.at(static_cast<float>(curve::curve_u(k)) * factor).x; });
}

Curve lifted(const Curve& of) {
    const float most = *std::max_element(of.rgb[0].begin(), of.rgb[0].end());
    return grey_curve([&](std::size_t k) {
        const auto u = static_cast<float>(curve::curve_u(k));
        return of.rgb[0][k] + 0.05F * most * u * u;
    });
}

Curve cut(const Curve& of, std::size_t end) {
    return grey_curve([&](std::size_t k) { return k < end ? of.rgb[0][k] : 0.0F; });
}

}  // namespace

std::array<std::vector<float>, 3> signal_from_curves(std::span<const Curve> curves) {
    const basis::CurveBasis basis(static_cast<std::uint32_t>(curves.size()));
    std::array<std::vector<float>, 3> signal;
    for (std::size_t c = 0; c < 3; ++c) {
        signal[c].resize(basis.coefficient_count());
        basis::project_rest(signal[c]);
        for (std::uint32_t m = 0; m < curves.size(); ++m) {
            basis::project_curve(basis, m, 1, curves[m].rgb[c], signal[c]);
        }
    }
    return signal;
}

SignalModel curve_signals(const std::vector<EditedMaterial>& materials) {
    std::array<std::vector<Curve>, kModelSignals> curves;
    for (const EditedMaterial& material : materials) {
        const Curve baked = grey(material.brdf.curves()[material.curve].curve);
        curves[0].push_back(baked);
        curves[1].push_back(stretched(baked, 1.5F));
        curves[2].push_back(stretched(baked, 0.6F));
        curves[3].push_back(lifted(baked));
        for (std::size_t i = 0; i < kSignalsPerKind; ++i) {
            curves[kSignalsPerKind + i].push_back(cut(baked, 24 + 48 * i));
        }
    }
    SignalModel model;
    for (const std::vector<Curve>& of_signal : curves) {
        model.signals.push_back(signal_from_curves(of_signal)[0]);
    }
    // rest; then for each curve its diffuse colour, scaling coefficient, and eight levels
    constexpr std::uint32_t kBandsOfCurve = 2 + basis::kDaubechies4Levels;
    model.band.push_back(0);
    for (std::uint32_t m = 0; m < materials.size(); ++m) {
        const std::uint32_t first = 1 + m * kBandsOfCurve;
        model.band.push_back(first);
        for (std::uint32_t j = 0; j < kCurveSamples; ++j) {
            model.band.push_back(first + 1 + static_cast<std::uint32_t>(std::bit_width(j)));
        }
    }
    const std::size_t bands = 1 + materials.size() * kBandsOfCurve;
    model.natural_weight.assign(bands, 0.0);
    std::vector<double> columns(bands);
    for (std::size_t j = 0; j < model.band.size(); ++j) {
        ++columns[model.band[j]];
        for (std::size_t i = 0; i < kSignalsPerKind; ++i) {
            model.natural_weight[model.band[j]] +=
                std::pow(double{model.signals[i][j]}, 2) / kSignalsPerKind;
        }
    }
    for (std::size_t band = 0; band < bands; ++band) {
        constexpr double kLeast = 1e-6;  // of a level that no natural signal has
        double& weight = model.natural_weight[band];
        weight = std::max(weight / columns[band], kLeast);
        model.step_growth.push_back(static_cast<float>(1 / std::sqrt(weight)));
    }
    // A highlight that is made four times as narrow is sixteen times as high, and so is what
    // quantisation leaves off beside it.
    model.further_bits = 4;
    return model;
}

}  // namespace relume::bake
