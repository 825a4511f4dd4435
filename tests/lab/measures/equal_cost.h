// Methods at equal cost: what each series leaves within it.
#pragma once

#include "tests/lab/measures/pareto.h"

#include <span>
#include <string>
#include <vector>

namespace relume::lab {

// A method at one budget.
struct CostedMethod {
    std::string series;
    CostAndError at;
};

struct EqualCostRow {
    std::string series;
    std::vector<double> errors;  // by cost; NaN: it costs more at every budget
};

// For each series, in the order in which they first occur, the least error that it has at no
// more than each of the costs.
[[nodiscard]] std::vector<EqualCostRow> errors_at_equal_cost(
    std::span<const CostedMethod> methods, std::span<const double> costs);

}  // namespace relume::lab
