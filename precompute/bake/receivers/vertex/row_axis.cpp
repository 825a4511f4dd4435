#include "precompute/bake/receivers/vertex/row_axis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::bake {
namespace {

using Axis = std::vector<double>;

Axis mean_of(Rows rows, std::span<const std::uint32_t> some) {
    Axis mean(rows[some[0]].size());
    for (const std::uint32_t i : some) {
        for (std::size_t j = 0; j < mean.size(); ++j) {
            mean[j] += rows[i][j] / static_cast<double>(some.size());
        }
    }
    return mean;
}

Axis difference(std::span<const float> row, const Axis& mean) {
    Axis off(mean.size());
    for (std::size_t j = 0; j < mean.size(); ++j) {
        off[j] = row[j] - mean[j];
    }
    return off;
}

double squared_length(const Axis& axis) {
    return std::inner_product(axis.begin(), axis.end(), axis.begin(), 0.0);
}

double along(std::span<const float> row, const Axis& mean, const Axis& axis) {
    double sum = 0;
    for (std::size_t j = 0; j < mean.size(); ++j) {
        sum += (row[j] - mean[j]) * axis[j];
    }
    return sum;
}

}  // namespace

std::vector<double> along_widest_axis(Rows rows, std::span<const std::uint32_t> some) {
    const Axis mean = mean_of(rows, some);
    Axis axis;
    double farthest = 0;
    for (const std::uint32_t i : some) {
        Axis off = difference(rows[i], mean);
        const double away = squared_length(off);
        if (away > farthest) {
            farthest = away;
            axis = std::move(off);
        }
    }
    // What rounding leaves of equal rows is no direction.
    constexpr double kRounding = 1e-12;
    if (!(farthest > kRounding * squared_length(mean))) {
        return {};
    }
    constexpr int kSteps = 5;
    for (int step = 0; step < kSteps; ++step) {
        Axis next(axis.size());
        for (const std::uint32_t i : some) {
            const double weight = along(rows[i], mean, axis);
            for (std::size_t j = 0; j < next.size(); ++j) {
                next[j] += weight * (rows[i][j] - mean[j]);
            }
        }
        const double length = std::sqrt(squared_length(next));
        for (double& value : next) {
            value /= length;
        }
        axis = std::move(next);
    }
    std::vector<double> places;
    places.reserve(some.size());
    for (const std::uint32_t i : some) {
        places.push_back(along(rows[i], mean, axis));
    }
    return places;
}

}  // namespace relume::bake
