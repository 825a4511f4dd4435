#include "server/engine/lighting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace relume::engine {

using transport::kColours;

Lighting::Lighting(const Scene& scene)
    : bands_(scene.bands()),
      band_count_(scene.band_count()),
      count_(scene.coefficient_count()),
      target_(kColours * count_),
      approximation_(kColours * count_) {}

void Lighting::set_target(std::span<const float> coefficients) {
    if (coefficients.size() != target_.size()) {
        throw std::invalid_argument(fmt::format("lighting has {} values, expected {} (3 x {})",
                                                coefficients.size(), target_.size(), count_));
    }
    const auto wrong = std::find_if_not(coefficients.begin(), coefficients.end(),
                                        [](float value) { return std::isfinite(value); });
    if (wrong != coefficients.end()) {
        throw std::invalid_argument(
            fmt::format("lighting value {} is {}, expected a finite number",
                        wrong - coefficients.begin(), *wrong));
    }
    std::copy(coefficients.begin(), coefficients.end(), target_.begin());
}

bool Lighting::differs(std::size_t column) const {
    for (std::size_t c = 0; c < kColours; ++c) {
        if (target(c, column) != approximation(c, column)) {
            return true;
        }
    }
    return false;
}

ColumnChange Lighting::difference(std::size_t column) const {
    ColumnChange change{.column = static_cast<std::uint32_t>(column)};
    for (std::size_t c = 0; c < kColours; ++c) {
        change.amount[c] = target(c, column) - approximation(c, column);
    }
    return change;
}

void Lighting::apply(std::size_t column) {
    for (std::size_t c = 0; c < kColours; ++c) {
        approximation_[c * count_ + column] = target_[c * count_ + column];
    }
}

void Lighting::apply_all() {
    approximation_ = target_;
}

void Lighting::reset_band(std::uint32_t band) {
    for (std::size_t j = 0; j < count_; ++j) {
        if (bands_[j] == band) {
            for (std::size_t c = 0; c < kColours; ++c) {
                approximation_[c * count_ + j] = 0;
            }
        }
    }
}

std::uint32_t Lighting::bands_to_reset() const {
    std::array<double, 8> from_zero{};
    std::array<double, 8> from_approximation{};
    for (std::size_t c = 0; c < kColours; ++c) {
        for (std::size_t j = 0; j < count_; ++j) {
            const double wanted = target(c, j);
            from_zero[bands_[j]] += std::abs(wanted);
            from_approximation[bands_[j]] += std::abs(wanted - double{approximation(c, j)});
        }
    }
    std::uint32_t mask = 0;
    for (std::uint32_t band = 0; band < band_count_; ++band) {
        mask |= from_zero[band] < from_approximation[band] ? 1U << band : 0U;
    }
    return mask;
}

}  // namespace relume::engine
