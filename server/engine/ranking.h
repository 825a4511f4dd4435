// How important every column's difference between lighting and approximation is.
#pragma once

#include "server/engine/lighting.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// Made once for a lighting; plans for any set of resets are then selected from it. Columns
// stand in the order of `Scene::columns_by_band`. Work is spread over the caller's arena, the
// result does not depend on it. Not thread-safe while being made.
class Ranking {
  public:
    // `weights` as Scene::weights.
    void rank(const Scene& scene, const Lighting& lighting, std::span<const float> weights);

    // Σ_c (weight·(L − L̃))², finite; kNoDifference where both are equal.
    [[nodiscard]] std::span<const float> as_shown() const { return as_shown_; }
    // The same were L̃ zero.
    [[nodiscard]] std::span<const float> from_nothing() const { return from_nothing_; }
    static constexpr float kNoDifference = -1;

    // Bands in which starting afresh is nearer to the target than what is shown,
    // ‖L_b‖₁ < ‖L_b − L̃_b‖₁ [Overbeck06 §5], as a bit mask.
    [[nodiscard]] std::uint32_t bands_nearer_from_nothing() const {
        return bands_nearer_from_nothing_;
    }

  private:
    // ‖L‖₁ and ‖L − L̃‖₁ over some columns.
    struct Distances {
        double from_nothing = 0;
        double as_shown = 0;
    };

    [[nodiscard]] Distances rank_chunk(const Scene& scene,
                                       const Lighting& lighting,
                                       std::span<const float> weights,
                                       const BandChunk& chunk);

    std::vector<float> as_shown_;       // [N]
    std::vector<float> from_nothing_;   // [N]
    std::vector<Distances> distances_;  // a chunk each
    std::uint32_t bands_nearer_from_nothing_ = 0;
};

}  // namespace relume::engine
