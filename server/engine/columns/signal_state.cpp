#include "server/engine/columns/signal_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace relume::engine {

using transport::kColours;

SignalState::SignalState(const ColumnTable& table)
    : bands_(table.bands()),
      count_(table.count()),
      target_(kColours * count_),
      approximation_(kColours * count_) {}

void SignalState::set_target(std::span<const float> coefficients) {
    if (coefficients.size() != target_.size()) {
        throw std::invalid_argument(fmt::format("signal has {} values, expected {} (3 x {})",
                                                coefficients.size(), target_.size(), count_));
    }
    const auto wrong =
        std::find_if_not(coefficients.begin(), coefficients.end(),
                         [](float value) { return std::abs(value) <= kLargestCoefficient; });
    if (wrong != coefficients.end()) {
        throw std::invalid_argument(
            fmt::format("signal value {} is {}, expected a number of at most {}",
                        wrong - coefficients.begin(), *wrong, kLargestCoefficient));
    }
    std::copy(coefficients.begin(), coefficients.end(), target_.begin());
}

ColumnChange SignalState::difference(std::size_t column) const {
    ColumnChange change{.column = static_cast<std::uint32_t>(column)};
    for (std::size_t c = 0; c < kColours; ++c) {
        change.from[c] = approximation(c, column);
        change.to[c] = target(c, column);
    }
    return change;
}

ColumnChange SignalState::whole(std::size_t column) const {
    ColumnChange change{.column = static_cast<std::uint32_t>(column)};
    for (std::size_t c = 0; c < kColours; ++c) {
        change.to[c] = target(c, column);
    }
    return change;
}

void SignalState::apply(const Plan& plan) {
    if (plan.bands_to_reset != 0) {
        for (std::size_t c = 0; c < kColours; ++c) {
            for (std::size_t j = 0; j < count_; ++j) {
                if (plan.resets(bands_[j])) {
                    approximation_[c * count_ + j] = 0;
                }
            }
        }
    }
    for (const ColumnChange& change : plan.changes) {
        for (std::size_t c = 0; c < kColours; ++c) {
            approximation_[c * count_ + change.column] = change.to[c];
        }
    }
}

void SignalState::apply_all() {
    approximation_ = target_;
}

}  // namespace relume::engine
