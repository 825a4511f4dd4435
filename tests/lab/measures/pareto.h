// Which methods nothing else beats in cost and error at once.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace relume::lab {

struct CostAndError {
    double cost = 0;
    double error = 0;
};

// Indices of the points that no other point is below in one and not above in the other,
// ascending by cost. Of equal points the first. Points with a NaN are left out.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace relume::lab
