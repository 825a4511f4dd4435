// One incremental relighting: the lighting asked for, the approximation shown, and the image.
#pragma once

#include "protocol/wire/session_state.h"
#include "server/engine/band_images.h"
#include "server/engine/cost_model.h"
#include "server/engine/error_estimate.h"
#include "server/engine/full_product.h"
#include "server/engine/lighting.h"
#include "server/engine/planner.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <memory>
#include <span>

namespace relume::engine {

// What one call of `advance` did.
struct StepReport {
    std::uint32_t applied = 0;    // coefficients whose columns were added
    std::uint32_t remaining = 0;  // coefficients in which approximation and target still differ
    std::uint32_t bands_reset = 0;  // bit b: band b was reset
    std::uint64_t bytes_touched = 0;
    double stated_error = 0;  // relative L2 of the image, estimated; 0 when exact
    bool image_changed = false;
    bool exact = false;
};

// Not thread-safe: one thread at a time calls it; inside, work is spread over oneTBB's arena of
// the caller. The image depends only on the history of calls, not on the number of threads; an
// exact image depends on the lighting alone, to the last bit.
class Session {
  public:
    Session(std::shared_ptr<const Scene> scene, wire::Strategy strategy);

    // Target lighting: Haar coefficients of radiance, planar [3][N], all of at most
    // kLargestCoefficient (throws std::invalid_argument otherwise, or when the count is wrong;
    // the session is unchanged).
    void set_lighting(std::span<const float> coefficients);
    // Takes effect with the next step. The approximation is kept.
    void set_strategy(wire::Strategy strategy) { strategy_ = strategy; }

    // One image's worth of work. New lighting: the method's resets, then the most important
    // differences between target and approximation within the budget. While the lighting rests:
    // more of them, and then (at once, where it takes only a few images' time) the *full
    // product* in slices of the budget, after which the image is exact and has forgotten its
    // history. Where the full product fits into one image's milliseconds, every image is
    // exact. Costs nothing when exact.
    StepReport advance(const wire::Budget& budget);

    // One image's worth of the method alone, under a budget of columns and bytes: what
    // `advance` does before it turns to the full product.
    StepReport advance_incrementally(const SelectionBudget& budget);

    // True when `advance` has nothing left to do under this budget: exact, or the target error
    // is met.
    [[nodiscard]] bool at_rest(const wire::Budget& budget) const;
    [[nodiscard]] bool exact() const { return exact_; }
    [[nodiscard]] double stated_error() const;
    [[nodiscard]] const Scene& scene() const { return *scene_; }

    // Approximation L̃, planar [3][N].
    [[nodiscard]] std::span<const float> approximation() const {
        return lighting_.approximation();
    }
    // Sums before tint, in the basis of the blocks (receiver_basis.h): [blocks][3][256].
    [[nodiscard]] std::span<const float> sums() const { return images_.total(); }
    // The relit image, tint applied: interleaved RGB, row by row from the top, 3·width·height
    // floats, linear radiance, premultiplied by coverage.
    void write_image(std::span<float> rgb) const;

  private:
    // Chooses; the approximation and the image stay as they are.
    [[nodiscard]] const Plan& next_plan(const SelectionBudget& budget);
    // Brings image, approximation and estimates to where the plan leads.
    void carry_out(const Plan& plan, StepReport& report);
    void state(StepReport& report) const;
    void advance_full_product(const wire::Budget& budget, StepReport& report);
    [[nodiscard]] bool full_product_is_next(const wire::Budget& budget) const;
    [[nodiscard]] bool full_product_fits_one_image(const wire::Budget& budget) const;
    [[nodiscard]] std::uint64_t bytes_per_image(const wire::Budget& budget) const;
    [[nodiscard]] SelectionBudget selection_budget(const wire::Budget& budget) const;
    void remove_drift(StepReport& report);

    std::shared_ptr<const Scene> scene_;
    wire::Strategy strategy_;
    Lighting lighting_;
    Planner planner_;
    BandImages images_;
    ErrorEstimate error_;
    CostModel cost_;
    FullProduct full_product_;
    std::uint32_t remaining_ = 0;
    bool lighting_is_new_ = false;
    // Error and choosing sketch do not know the approximation: it was made exact without them.
    bool estimates_are_stale_ = false;
    bool exact_ = true;  // a session begins with no light and a black image
};

}  // namespace relume::engine
