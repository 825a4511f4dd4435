#include "precompute/factors/curve_product.h"

#include <algorithm>
#include <cmath>

namespace relume::factors {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMostSweeps = 300;
constexpr double kLeastGain = 1e-4;  // of the error's square, a sweep; below it the fit ends

// For one curve: Σ w·hat·q·ρ and Σ w·hat·q·ρ̂, q being ρ̂ without this curve. Their ratio is
// 1 where the error has no slope.
struct Ratio {
    VectorXd measured = VectorXd::Zero(kCurveSize);
    VectorXd fitted = VectorXd::Zero(kCurveSize);

    void add(const curve::CurvePlace& place, double weight, double value, double fit) {
        const auto k = static_cast<Index>(place.sample);
        const auto fraction = static_cast<double>(place.fraction);
        measured[k] += (1 - fraction) * weight * value;
        measured[k + 1] += fraction * weight * value;
        fitted[k] += (1 - fraction) * weight * fit;
        fitted[k + 1] += fraction * weight * fit;
    }
    // What a sample of the curve is multiplied by; 1 where no direction meets it.
    [[nodiscard]] double at(Index k) const {
        return fitted[k] > 0 ? measured[k] / fitted[k] : 1.0;
    }
};

double beyond(const CurveFitSample& sample, int colour, double diffuse) {
    return std::max(0.0, sample.value[colour] - diffuse);
}

void improve_column(const CurveFitSamples& samples,
                    int colour,
                    double diffuse,
                    Index column,
                    CurveColumns& columns) {
    Ratio ratio;
    for (const CurveFitSample& sample : samples.samples) {
        const std::array<double, 4> factors = factors_at(columns, sample);
        for (std::size_t i = 0; i < 4; ++i) {
            if (kColumnOfPlace[i] == column) {
                double others = 1;
                for (std::size_t j = 0; j < 4; ++j) {
                    others *= j == i ? 1.0 : factors[j];
                }
                ratio.add(sample.places[i], sample.solid_angle * others,
                          beyond(sample, colour, diffuse), others * factors[i]);
            }
        }
    }
    for (Index k = 0; k < kCurveSize; ++k) {
        // The third curve stands in the product twice, so that half of the step is its own.
        const double step = column == 2 ? std::sqrt(ratio.at(k)) : ratio.at(k);
        columns(k, column) =
            std::min(columns(k, column) * step, static_cast<double>(curve::kMostCurveValue));
    }
}

double square_error(const CurveFitSamples& samples,
                    int colour,
                    double diffuse,
                    const CurveColumns& columns) {
    double sum = 0;
    for (const CurveFitSample& sample : samples.samples) {
        const std::array<double, 4> f = factors_at(columns, sample);
        const double error = f[0] * f[1] * f[2] * f[3] - beyond(sample, colour, diffuse);
        sum += sample.solid_angle * error * error;
    }
    return sum;
}

}  // namespace

void improve_nonnegative(const CurveFitSamples& samples,
                         int colour,
                         double diffuse,
                         CurveColumns& columns) {
    if (samples.mean[colour] == 0) {
        return;
    }
    CurveColumns best = columns;
    double least = square_error(samples, colour, diffuse, columns);
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        for (Index column = 0; column < kFittedCurves; ++column) {
            improve_column(samples, colour, diffuse, column, columns);
        }
        const double error = square_error(samples, colour, diffuse, columns);
        if (error >= least) {
            break;
        }
        const bool is_still = least - error <= kLeastGain * least;
        best = columns;
        least = error;
        if (is_still) {
            break;
        }
    }
    columns = best;
}

}  // namespace relume::factors
