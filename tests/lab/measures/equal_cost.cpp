#include "tests/lab/measures/equal_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::lab {

std::vector<EqualCostRow> errors_at_equal_cost(std::span<const CostedMethod> methods,
                                               std::span<const double> costs) {
    std::vector<EqualCostRow> rows;
    for (const CostedMethod& method : methods) {
        auto row = std::find_if(rows.begin(), rows.end(), [&](const EqualCostRow& one) {
            return one.series == method.series;
        });
        if (row == rows.end()) {
            rows.push_back({.series = method.series,
                            .errors = std::vector<double>(
                                costs.size(), std::numeric_limits<double>::quiet_NaN())});
            row = rows.end() - 1;
        }
        for (std::size_t i = 0; i < costs.size(); ++i) {
            if (method.at.cost <= costs[i]) {
                row->errors[i] = std::fmin(row->errors[i], method.at.error);
            }
        }
    }
    return rows;
}

}  // namespace relume::lab
