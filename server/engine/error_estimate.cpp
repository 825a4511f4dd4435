#include "server/engine/error_estimate.h"

#include <cmath>

namespace relume::engine {
namespace {

double squared_norm(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) {
        sum += value * value;
    }
    return sum;
}

}  // namespace

ErrorEstimate::ErrorEstimate(const Scene& scene)
    : target_(scene, scene.transport().stating_sketch()), approximation_(target_) {}

double ErrorEstimate::relative_l2() const {
    const std::vector<double> target = target_.sum();
    const std::vector<double> approximation = approximation_.sum();
    double squared_difference = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
        const double difference = target[i] - approximation[i];
        squared_difference += difference * difference;
    }
    const double norm = squared_norm(target);
    if (norm == 0) {
        return squared_difference == 0 ? 0 : 1;
    }
    return std::sqrt(squared_difference / norm);
}

double ErrorEstimate::shown_norm() const {
    return std::sqrt(squared_norm(approximation_.sum()));
}

}  // namespace relume::engine
