#include "tests/lab/curves/curve_bases.h"

#include "protocol/basis/daubechies4.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace relume::lab {
namespace {

constexpr Eigen::Index kSize = curve::kCurveSamples;

// Rows are the functions of an orthonormal basis.
Eigen::MatrixXd haar_matrix() {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kSize, kSize);
    matrix.row(0).setConstant(1 / std::sqrt(static_cast<double>(kSize)));
    for (Eigen::Index count = 1, row = 1; count < kSize; count *= 2) {
        const Eigen::Index width = kSize / count;
        const double height = 1 / std::sqrt(static_cast<double>(width));
        for (Eigen::Index i = 0; i < count; ++i, ++row) {
            matrix.row(row).segment(i * width, width / 2).setConstant(height);
            matrix.row(row).segment(i * width + width / 2, width / 2).setConstant(-height);
        }
    }
    return matrix;
}

Eigen::MatrixXd daubechies4_matrix() {
    Eigen::MatrixXd matrix(kSize, kSize);
    std::array<float, curve::kCurveSamples> values{};
    for (Eigen::Index j = 0; j < kSize; ++j) {
        values.fill(0);
        values[static_cast<std::size_t>(j)] = 1;
        basis::daubechies4_forward(values, values);
        for (Eigen::Index i = 0; i < kSize; ++i) {
            matrix(i, j) = double{values[static_cast<std::size_t>(i)]};
        }
    }
    return matrix;
}

// A column a control point: the uniform cubic B-spline over u.
Eigen::MatrixXd spline_matrix(std::uint32_t points) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kSize, points);
    const double spans = points - 3.0;
    for (Eigen::Index k = 0; k < kSize; ++k) {
        const double at = curve::curve_u(static_cast<std::size_t>(k)) * spans;
        const double span = std::min(std::floor(at), spans - 1);
        const double t = at - span;
        const auto first = static_cast<Eigen::Index>(span);
        matrix(k, first) = std::pow(1 - t, 3) / 6;
        matrix(k, first + 1) = (3 * t * t * t - 6 * t * t + 4) / 6;
        matrix(k, first + 2) = (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6;
        matrix(k, first + 3) = t * t * t / 6;
    }
    return matrix;
}

using Change = std::array<Eigen::VectorXd, 3>;

// What the terms that matter most leave of a change; the same terms for all colours.
Change rest_in(const Eigen::MatrixXd& basis,
               const CurveGram& gram,
               const Change& change,
               std::uint32_t terms) {
    Change coefficients;
    Eigen::VectorXd importance = Eigen::VectorXd::Zero(kSize);
    for (std::size_t c = 0; c < 3; ++c) {
        coefficients[c] = basis * change[c];
        const Eigen::VectorXd energy =
            (basis * gram.of_samples[c]).cwiseProduct(basis).rowwise().sum();
        importance += coefficients[c].cwiseAbs2().cwiseProduct(energy);
    }
    std::vector<Eigen::Index> order(static_cast<std::size_t>(kSize));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
        return importance[a] > importance[b];
    });
    Change rest;
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::uint32_t i = 0; i < terms; ++i) {
            coefficients[c][order[i]] = 0;
        }
        rest[c] = basis.transpose() * coefficients[c];
    }
    return rest;
}

}  // namespace

std::string_view name_of(CurveTerms terms) {
    switch (terms) {
        case CurveTerms::daubechies4:
            return "daubechies4";
        case CurveTerms::haar:
            return "haar";
        case CurveTerms::splines:
            return "splines";
    }
    return {};
}

double error_of_terms(const CurveGram& gram,
                      const Change& change,
                      CurveTerms basis,
                      std::uint32_t terms) {
    const double norm = gram.squared_norm(change);
    if (norm == 0) {
        return 0;
    }
    Change rest;
    if (basis == CurveTerms::splines) {
        const Eigen::MatrixXd matrix = spline_matrix(terms);
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(matrix);
        for (std::size_t c = 0; c < 3; ++c) {
            rest[c] = change[c] - matrix * fit.solve(change[c]);
        }
    } else {
        const Eigen::MatrixXd matrix =
            basis == CurveTerms::haar ? haar_matrix() : daubechies4_matrix();
        rest = rest_in(matrix, gram, change, terms);
    }
    return std::sqrt(gram.squared_norm(rest) / norm);
}

}  // namespace relume::lab
