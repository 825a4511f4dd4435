// Target signal L and its approximation L̃, as coefficients of the scene's basis.
#pragma once

#include "server/engine/columns/column_table.h"
#include "server/engine/columns/plan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Larger coefficients are refused: differences of two, times transport, and their sums must
// stay finite in float. Images of a scene that reflects no more than it gets are below 10⁴
// times this; the wire's largest lights reach 10²³.
inline constexpr float kLargestCoefficient = 1e30F;

// Both signals are planar, [3][N]. Not thread-safe.
class SignalState {
  public:
    explicit SignalState(const ColumnTable& table);

    // Throws std::invalid_argument when the count is not 3·N or a value is not a number of at
    // most kLargestCoefficient, either sign.
    void set_target(std::span<const float> coefficients);

    [[nodiscard]] std::span<const float> target() const { return target_; }
    [[nodiscard]] std::span<const float> approximation() const { return approximation_; }
    // The change of one column from L̃ to L.
    [[nodiscard]] ColumnChange difference(std::size_t column) const;
    // The change of one column from zero to L.
    [[nodiscard]] ColumnChange whole(std::size_t column) const;

    // Carries the plan out on L̃: zero in the bands that begin anew, then L_j in every column
    // that is changed.
    void apply(const Plan& plan);
    // L̃ := L.
    void apply_all();

  private:
    [[nodiscard]] float target(std::size_t colour, std::size_t column) const {
        return target_[colour * count_ + column];
    }
    [[nodiscard]] float approximation(std::size_t colour, std::size_t column) const {
        return approximation_[colour * count_ + column];
    }

    std::span<const std::uint8_t> bands_;
    std::size_t count_;
    std::vector<float> target_;
    std::vector<float> approximation_;
};

}  // namespace relume::engine
