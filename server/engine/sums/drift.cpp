#include "server/engine/sums/drift.h"

#include <cmath>
#include <limits>

namespace relume::engine {

Drift Drift::of_unknown_norm() {
    Drift drift;
    drift.updates_since_ = kUnknown;
    return drift;
}

void Drift::set_norm(double measured) {
    norm_ = known_norm_ = measured;
    updates_since_ = 0;
}

bool Drift::add(double norm_of_changes, std::size_t changes) {
    constexpr unsigned kUpdatesUnmeasured = 16;
    constexpr double kLoose = 2;
    // Of few columns the sum of norms says enough; of many, far too much.
    constexpr std::size_t kFewChanges = 64;
    if (norm_is_unknown()) {
        return true;
    }
    const bool begins = norm_ == 0 && updates_since_ == 0;
    norm_ += norm_of_changes;
    if (begins) {
        known_norm_ = norm_;
        return changes > kFewChanges;
    }
    if (updates_since_ >= kUpdatesUnmeasured || norm_ > kLoose * known_norm_) {
        return true;
    }
    ++updates_since_;
    return false;
}

double rounding_error(double squared_norms) {
    return std::numeric_limits<float>::epsilon() * std::sqrt(squared_norms);
}

}  // namespace relume::engine
