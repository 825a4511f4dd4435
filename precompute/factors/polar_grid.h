// Polar angles at which a BRDF is sampled: the rows of a direction table, each standing for the
// angles nearest to it.
#pragma once

#include <cstdint>
#include <vector>

namespace relume::factors {

struct PolarGrid {
    // θ of each row, in radians; the last row, which is the horizon, is sampled in the middle
    // of its half cell, because a BRDF may have no finite value at the horizon.
    std::vector<double> thetas;
    // ∫ cos θ sin θ dθ over each row's cell; their sum is 1/2.
    std::vector<double> weights;

    // 2 … 512 rows.
    explicit PolarGrid(std::uint32_t rows);
    [[nodiscard]] std::uint32_t rows() const {
        return static_cast<std::uint32_t>(thetas.size());
    }
};

// As many rows as put two into a highlight's width, at least 49 and at most 512.
[[nodiscard]] std::uint32_t rows_for_width(double width_rad);

}  // namespace relume::factors
