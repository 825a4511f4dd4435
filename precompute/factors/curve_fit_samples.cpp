#include "precompute/factors/curve_fit_samples.h"

#include "precompute/factors/error.h"
#include "protocol/curve/curve_angle.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace relume::factors {
namespace {

constexpr double kPi = std::numbers::pi;

double fraction(double x) {
    return x - std::floor(x);
}

// Nothing where a direction lies below the horizon.
std::optional<CurveFitSample> sample_at(double u_half, double difference, double azimuth) {
    using curve::CurveAngle;
    const double theta_half = curve::degrees_from_u(CurveAngle::half, u_half) * kPi / 180;
    const double theta_difference = difference * kPi / 2;
    const double phi = azimuth * 2 * kPi;
    const double x = std::sin(theta_difference) * std::cos(phi);
    const double y = std::sin(theta_difference) * std::sin(phi);
    const double z = std::cos(theta_difference);
    const double c = std::cos(theta_half);
    const double s = std::sin(theta_half);
    CurveFitSample sample;
    sample.wi = Imath::V3f(Imath::V3d(c * x + s * z, y, -s * x + c * z));
    sample.wo = Imath::V3f(Imath::V3d(-c * x + s * z, -y, s * x + c * z));
    if (sample.wi.z <= 0 || sample.wo.z <= 0) {
        return std::nullopt;
    }
    constexpr std::array kAngles{CurveAngle::half, CurveAngle::difference,
                                 CurveAngle::incidence, CurveAngle::viewing};
    for (std::size_t i = 0; i < kAngles.size(); ++i) {
        sample.places[i] =
            curve::curve_place(curve::u_from_directions(kAngles[i], sample.wi, sample.wo));
    }
    sample.cosines = static_cast<double>(sample.wi.z) * static_cast<double>(sample.wo.z);
    sample.spread = std::sin(2 * theta_difference);
    // dωi dωo = 4 cos θd dωh dωd, and θh goes with the square of u.
    sample.solid_angle = sample.cosines * sample.spread * s * u_half;
    return sample;
}

// Negative values become 0, and the mean is taken.
void take_values(CurveFitSamples& all) {
    double weights = 0;
    for (CurveFitSample& sample : all.samples) {
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(sample.value[c])) {
                throw FactorError(fmt::format(
                    "a BRDF to be factored into curves is {} from ({}, {}, {}) to ({}, {}, "
                    "{}), expected a finite value",
                    sample.value[c], sample.wi.x, sample.wi.y, sample.wi.z, sample.wo.x,
                    sample.wo.y, sample.wo.z));
            }
            if (sample.value[c] < 0) {
                sample.value[c] = 0;
                ++all.negative_count;
            }
        }
        all.mean += sample.value * sample.solid_angle;
        weights += sample.solid_angle;
    }
    all.mean /= weights;
    if (all.mean == Imath::V3d(0)) {
        throw FactorError(
            "a BRDF to be factored into curves is black everywhere, expected one that "
            "reflects");
    }
}

}  // namespace

double CurveFitSamples::quantile(int colour, double part) const {
    std::vector<std::pair<double, double>> values;  // and their solid angles
    double whole = 0;
    for (const CurveFitSample& sample : samples) {
        values.emplace_back(sample.value[colour], sample.solid_angle);
        whole += sample.solid_angle;
    }
    std::sort(values.begin(), values.end());
    double below = 0;
    for (const auto& [value, solid_angle] : values) {
        below += solid_angle;
        if (below >= part * whole) {
            return value;
        }
    }
    return values.back().first;
}

CurveFitSamples curve_fit_samples(const BrdfLobes& lobes, std::size_t count, double shift) {
    // The sequence of [Roberts18] in three dimensions; g⁴ = g + 1.
    constexpr double kG = 1.22074408460575947536;
    CurveFitSamples all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto n = static_cast<double>(i + 1);
        if (auto sample = sample_at(fraction(shift + n / kG), fraction(shift + n / (kG * kG)),
                                    fraction(shift + n / (kG * kG * kG)))) {
            all.samples.push_back(*sample);
        }
    }
    tbb::parallel_for(std::size_t{0}, all.samples.size(), [&](std::size_t i) {
        CurveFitSample& sample = all.samples[i];
        std::vector<float> values(lobes.count());
        lobes.evaluate(sample.wo, {{&sample.wi.x, 1}, {&sample.wi.y, 1}, {&sample.wi.z, 1}},
                       values);
        for (std::size_t l = 0; l < lobes.count(); ++l) {
            sample.value += Imath::V3d(lobes.mean_colours[l]) * static_cast<double>(values[l]);
        }
    });
    take_values(all);
    return all;
}

}  // namespace relume::factors
