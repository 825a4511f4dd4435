#include "tests/lab/measures/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace relume::lab {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isnan(points[i].cost) && !std::isnan(points[i].error)) {
            order.push_back(i);
        }
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(points[a].cost, points[a].error, a) <
               std::tuple(points[b].cost, points[b].error, b);
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (points[i].error < least) {
            least = points[i].error;
            front.push_back(i);
        }
    }
    return front;
}

}  // namespace relume::lab
