#include "precompute/factors/curve_product.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace relume::factors {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kUnknowns = kFittedCurves * kCurveSize;
// Weight of a squared second difference, in units of the weight that samples of a curve have on
// average: little where there is data, and all where there is none.
constexpr double kSmoothness = 1e-2;
// Of a squared first difference: beyond the data a curve goes on flat, not along its slope.
constexpr double kFlatness = 1e-5;
// Of a squared logarithm: fixes the factor that may move from one curve to another.
constexpr double kRidge = 1e-11;
// What is less than this, in units of the floor, has the logarithm of this.
constexpr double kLeastOfFloor = 1e-2;

// Unknowns of a sample of directions, and with which weight its logarithm has each.
struct Row {
    std::array<Index, 8> unknowns;
    std::array<double, 8> weights;

    explicit Row(const CurveFitSample& sample) {
        for (std::size_t i = 0; i < 4; ++i) {
            const curve::CurvePlace& place = sample.places[i];
            const Index first =
                kColumnOfPlace[i] * kCurveSize + static_cast<Index>(place.sample);
            unknowns[2 * i] = first;
            unknowns[2 * i + 1] = first + 1;
            weights[2 * i] = 1 - static_cast<double>(place.fraction);
            weights[2 * i + 1] = static_cast<double>(place.fraction);
        }
    }
};

// Adds weight·(Σ coefficients·unknowns)², the unknowns from `first` on.
template <std::size_t Count>
void add_square(MatrixXd& normal,
                Index first,
                const std::array<double, Count>& coefficients,
                double weight) {
    for (std::size_t a = 0; a < Count; ++a) {
        for (std::size_t b = 0; b < Count; ++b) {
            normal(first + static_cast<Index>(a), first + static_cast<Index>(b)) +=
                weight * coefficients[a] * coefficients[b];
        }
    }
}

void add_smoothness(MatrixXd& normal) {
    const double weight = normal.trace() / static_cast<double>(kUnknowns);
    for (Index column = 0; column < kFittedCurves; ++column) {
        const Index first = column * kCurveSize;
        for (Index k = 0; k + 1 < kCurveSize; ++k) {
            add_square(normal, first + k, std::array{-1.0, 1.0}, kFlatness * weight);
            if (k + 2 < kCurveSize) {
                add_square(normal, first + k, std::array{1.0, -2.0, 1.0}, kSmoothness * weight);
            }
        }
    }
    normal.diagonal().array() += kRidge * weight;
}

// Fresnel, incidence and viewing get the mean logarithm 0 over the samples' places.
void balance(const CurveFitSamples& samples, CurveColumns& logarithms) {
    for (Index column = 1; column < kFittedCurves; ++column) {
        double sum = 0;
        double weights = 0;
        for (const CurveFitSample& sample : samples.samples) {
            const double weight = sample.cosines * sample.spread;
            sum += weight * value_at(logarithms, column,
                                     sample.places[static_cast<std::size_t>(column)]);
            weights += weight;
        }
        const double mean = sum / weights;
        logarithms.col(column).array() -= mean;
        logarithms.col(0).array() += column == 2 ? 2 * mean : mean;
    }
}

}  // namespace

CurveColumns homomorphic_columns(const CurveFitSamples& samples, int colour, double diffuse) {
    if (samples.mean[colour] == 0) {
        CurveColumns black = CurveColumns::Ones();
        black.col(0).setZero();
        return black;
    }
    MatrixXd normal = MatrixXd::Zero(kUnknowns, kUnknowns);
    VectorXd right = VectorXd::Zero(kUnknowns);
    const double floor = samples.floor()[colour];
    for (const CurveFitSample& sample : samples.samples) {
        const Row row(sample);
        const double beyond = std::max(sample.value[colour] - diffuse, kLeastOfFloor * floor);
        // An error of ln beyond is this part of one of ln(ρ + floor). Its square would leave
        // curves undetermined beside a diffuse ground.
        const double part = beyond / (beyond + diffuse + floor);
        const double weight = sample.cosines * sample.spread * part;
        const double logarithm = std::log(beyond);
        for (std::size_t a = 0; a < 8; ++a) {
            right[row.unknowns[a]] += weight * row.weights[a] * logarithm;
            for (std::size_t b = 0; b < 8; ++b) {
                normal(row.unknowns[a], row.unknowns[b]) +=
                    weight * row.weights[a] * row.weights[b];
            }
        }
    }
    add_smoothness(normal);
    const VectorXd solution = normal.ldlt().solve(right);
    CurveColumns logarithms =
        Eigen::Map<const MatrixXd>(solution.data(), kCurveSize, kFittedCurves);
    balance(samples, logarithms);
    return logarithms.array().exp().min(static_cast<double>(curve::kMostCurveValue));
}

}  // namespace relume::factors
