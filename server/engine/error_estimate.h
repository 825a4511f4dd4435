// The stated error: relative L2 distance of the image shown from the image asked for,
// estimated from the sketch of the transport at a cost independent of the image's size.
#pragma once

#include "server/engine/choosing/band_sketches.h"
#include "server/engine/columns/column_table.h"

#include <span>

namespace relume::engine {

// Keeps S·T·L and S·T·L̃ for the stating rows S, in double precision. The estimate
// ‖S T (L − L̃)‖ / ‖S T L‖ has a relative standard deviation of about 1/√(2R) where the colours
// are alike, down to 1/√(6R) where they are not. Nothing is chosen by these rows, because an
// estimate that has been minimised over is biased. Not thread-safe.
class ErrorEstimate {
  public:
    explicit ErrorEstimate(const ColumnTable& table);

    // A target may lack columns that hardly count. The approximation must have all of its
    // columns, because it may be far brighter than the next target.
    void set_target(const SignificantColumns& target) { target_.set(target); }
    void set_approximation(const SignificantColumns& shown) { approximation_.set(shown); }
    // The plan has been carried out on L̃.
    void apply(const Plan& plan) { approximation_.apply(plan); }
    // L̃ has been set to this target as a whole.
    void approximation_is_target(const SignificantColumns& target) {
        target_.set(target);
        approximation_ = target_;
    }

    // How much the receivers of each block count in the image, [blocks]: of a view that sees
    // some of them alone, or some larger than others. 1 at first.
    void set_block_weights(std::span<const float> weights) {
        target_.set_block_weights(weights);
        approximation_.set_block_weights(weights);
    }

    // 0 when both are equal; 1 when nothing of the target is shown. When the target is black,
    // 0 if the approximation is too, else 1.
    [[nodiscard]] double relative_l2() const;
    // Estimated ‖T L̃‖ over all receivers and colours, tint applied, whatever their weights.
    [[nodiscard]] double shown_norm() const;

  private:
    BandSketches target_;
    BandSketches approximation_;
};

}  // namespace relume::engine
