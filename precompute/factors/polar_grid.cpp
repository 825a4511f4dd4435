#include "precompute/factors/polar_grid.h"

#include "protocol/brdf/direction_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::factors {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;
constexpr double kLeastRows = 49;
constexpr double kRowsPerWidth = 2;

}  // namespace

PolarGrid::PolarGrid(std::uint32_t rows) {
    const double step = kHalfPi / (rows - 1);
    for (std::uint32_t row = 0; row < rows; ++row) {
        const double theta = row * step;
        const double from = std::sin(std::max(0.0, theta - step / 2));
        const double to = std::sin(std::min(kHalfPi, theta + step / 2));
        thetas.push_back(row + 1 < rows ? theta : kHalfPi - step / 4);
        weights.push_back((to * to - from * from) / 2);
    }
}

std::uint32_t rows_for_width(double width_rad) {
    const double rows = std::ceil(kRowsPerWidth * kHalfPi / width_rad) + 1;
    return static_cast<std::uint32_t>(
        std::clamp(rows, kLeastRows, static_cast<double>(brdf::TableShape::kMostRows)));
}

}  // namespace relume::factors
