// Target lighting L and its approximation L̃, as Haar coefficients.
#pragma once

#include "server/engine/column_change.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Planar [3][N] both. Not thread-safe.
class Lighting {
  public:
    explicit Lighting(const Scene& scene);

    // Throws std::invalid_argument when the count is not 3·N or a value is not finite.
    void set_target(std::span<const float> coefficients);

    [[nodiscard]] std::span<const float> target() const { return target_; }
    [[nodiscard]] std::span<const float> approximation() const { return approximation_; }
    [[nodiscard]] bool differs(std::size_t column) const;
    // L − L̃ of one column.
    [[nodiscard]] ColumnChange difference(std::size_t column) const;

    // L̃_j := L_j.
    void apply(std::size_t column);
    void apply_all();
    // L̃ := 0 in one band.
    void reset_band(std::uint32_t band);

    // Bands in which starting afresh is nearer to the target than what is shown,
    // ‖L_b‖₁ < ‖L_b − L̃_b‖₁ [Overbeck06 §5], as a bit mask.
    [[nodiscard]] std::uint32_t bands_to_reset() const;

  private:
    [[nodiscard]] float target(std::size_t colour, std::size_t column) const {
        return target_[colour * count_ + column];
    }
    [[nodiscard]] float approximation(std::size_t colour, std::size_t column) const {
        return approximation_[colour * count_ + column];
    }

    std::span<const std::uint8_t> bands_;
    std::uint32_t band_count_;
    std::size_t count_;
    std::vector<float> target_;
    std::vector<float> approximation_;
};

}  // namespace relume::engine
