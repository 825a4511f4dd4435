#include "server/engine/error_estimate.h"

#include <cmath>

namespace relume::engine {

ErrorEstimate::ErrorEstimate(const ColumnTable& table)
    : target_(table, table.stating_sketch()), approximation_(target_) {}

double ErrorEstimate::relative_l2() const {
    double squared_difference = 0;
    double squared_norm = 0;
    for (std::size_t r = 0; r < target_.size(); ++r) {
        const double target = target_.sum(r);
        const double difference = target - approximation_.sum(r);
        const double weight = target_.row_weight(r);
        squared_difference += weight * difference * difference;
        squared_norm += weight * target * target;
    }
    if (squared_norm == 0) {
        return squared_difference == 0 ? 0 : 1;
    }
    return std::sqrt(squared_difference / squared_norm);
}

double ErrorEstimate::shown_norm() const {
    double squared_norm = 0;
    for (std::size_t r = 0; r < approximation_.size(); ++r) {
        const double shown = approximation_.sum(r);
        squared_norm += shown * shown;
    }
    return std::sqrt(squared_norm);
}

}  // namespace relume::engine
