// One incremental relighting: the signal asked for, the approximation shown, and the image.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "server/engine/choosing/planner.h"
#include "server/engine/columns/signal_state.h"
#include "server/engine/cost_model.h"
#include "server/engine/error_estimate.h"
#include "server/engine/sums/band_sums.h"
#include "server/engine/sums/full_product.h"
#include "server/engine/workspace.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace relume::engine {

// What one call of `advance` did.
struct StepReport {
    std::uint32_t applied = 0;    // coefficients whose columns were added
    std::uint32_t remaining = 0;  // coefficients in which approximation and target still differ
    std::uint32_t bands_reset = 0;  // bit b: band b was reset
    std::uint64_t bytes_touched = 0;
    std::uint64_t band_bytes = 0;  // BandSums::bytes_of_bands
    double stated_error = 0;       // relative L2 of the image, estimated; 0 when exact
    bool image_changed = false;
    bool exact = false;
};

class Session;

// A session's part in a step that several take together.
struct SessionStep {
    Session* session = nullptr;
    relighting::Budget budget;  // its milliseconds are for all sessions of the step together
    // The longest that one call takes, whatever the budget. The call ends about then, judged by
    // what such work has taken so far; the next call goes on.
    double ceiling_milliseconds = std::numeric_limits<double>::infinity();
    StepReport report;  // what it did
};

// Not thread-safe: one thread at a time calls it. Its work is spread over the caller's oneTBB
// arena. The image depends on the history of calls, not on the number of threads nor on the
// sessions that are relit together with it. An exact image depends on the signal alone, to the
// last bit.
class Session {
  public:
    Session(std::shared_ptr<const Workspace> workspace, relighting::Strategy strategy);

    // The signal that is asked for: coefficients in the operator's basis, planar [3][N], each
    // of at most kLargestCoefficient. Throws std::invalid_argument for others or another count,
    // and leaves the session as it was.
    void set_target(std::span<const float> coefficients);
    // Takes effect with the next step. The approximation is kept.
    void set_strategy(relighting::Strategy strategy) { strategy_ = strategy; }

    // How much the receivers of each block count in the image, [blocks], not negative and not
    // all zero: by it errors are predicted and stated. All count alike at first. While the
    // image changes, sums of blocks that count for nothing may be left as they are; those that
    // count again are brought up to date at once. An exact image is exact in all blocks.
    void set_block_weights(std::span<const float> weights);

    // One image's worth of work.
    // - After a new target: the method's resets, then the most important differences between
    //   target and approximation within the budget.
    // - While the target rests: more of these differences; then, or at once where it takes only
    //   a few images' time, the *full product* in slices of the budget. The image is exact
    //   after that, and a function of the target alone.
    // - Where the full product fits into one image's milliseconds, every image is exact.
    // - Costs nothing when the image is exact.
    StepReport advance(const relighting::Budget& budget);

    // The same for each of several sessions of one workspace, no two the same, in one sweep
    // over the transport: columns that several of them use are read and decoded once.
    // Milliseconds are divided equally. Under a budget of coefficients every session gets the
    // bits that it would get alone.
    static void advance_together(std::span<SessionStep> steps);

    // One image's worth of the method alone, never the full product, under a budget of columns
    // and bytes.
    StepReport advance_incrementally(const SelectionBudget& budget);

    // Whether `advance` has nothing left to do under this budget: the image is exact, or meets
    // the target error.
    [[nodiscard]] bool at_rest(const relighting::Budget& budget) const;
    [[nodiscard]] bool exact() const { return exact_; }
    // Whether image and stated error are still those of the target before: a full product of
    // the new target has begun under a ceiling and is not done.
    [[nodiscard]] bool shows_target_before() const {
        return target_is_new_ && full_product_.running();
    }
    [[nodiscard]] double stated_error() const;
    // Estimated length of the image shown, over all receivers and colours.
    [[nodiscard]] double shown_norm() const { return error_.shown_norm(); }
    [[nodiscard]] const Workspace& workspace() const { return *workspace_; }

    // Approximation L̃, planar [3][N].
    [[nodiscard]] std::span<const float> approximation() const {
        return signal_.approximation();
    }
    // What a view makes the image of: [blocks][3][256], as TransportOperator says. Those of
    // blocks that count for nothing may be of an earlier image, unless this one is exact.
    [[nodiscard]] std::span<const float> sums() const { return sums_.total(); }

  private:
    // What a step is about to do. The plan belongs to the planner and is valid until it chooses
    // again.
    enum class Work : std::uint8_t { nothing, plan, full_product };
    struct Decision {
        Work work = Work::nothing;
        const Plan* plan = nullptr;
    };
    // What a session may take in a step that several sessions take together.
    struct Allowance {
        relighting::Budget budget;
        std::size_t sessions = 1;  // among which its milliseconds are divided
        double ceiling_milliseconds = std::numeric_limits<double>::infinity();
    };

    [[nodiscard]] Decision decide(const Allowance& allowance);
    // Chooses; the approximation and the image stay as they are.
    [[nodiscard]] const Plan& next_plan(const SelectionBudget& budget);
    // Brings images, approximations and estimates to where the plans lead.
    struct PlannedStep {
        Session* session;
        const Plan* plan;
        StepReport* report;
    };
    static void carry_out(std::span<const PlannedStep> steps);
    // Gives the estimates the target without columns that do not show beside such an error.
    void set_target_of_estimates(double expected_error);
    // Gives them more of its columns where the error has become smaller than expected.
    void refine_estimates();
    void plan_is_carried_out(const Plan& plan, StepReport& report);
    static void advance_full_products(std::span<SessionStep* const> steps,
                                      std::size_t sessions);
    void full_product_is_done(StepReport& report);
    void state(StepReport& report) const;
    [[nodiscard]] bool full_product_is_next(const Allowance& allowance) const;
    [[nodiscard]] bool full_product_fits_one_image(const Allowance& allowance) const;
    [[nodiscard]] std::uint64_t product_bytes_per_image(const Allowance& allowance) const;
    [[nodiscard]] std::uint64_t product_bytes_per_slice(const Allowance& allowance) const;
    [[nodiscard]] SelectionBudget selection_budget(const Allowance& allowance) const;
    void remove_drift(StepReport& report);

    std::shared_ptr<const Workspace> workspace_;
    relighting::Strategy strategy_;
    SignalState signal_;
    SignificantColumns significant_;  // of what the sketches were last made from
    Planner planner_;
    BandSums sums_;
    ErrorEstimate error_;
    CostModel cost_;          // of columns that are chosen
    CostModel product_cost_;  // of the full product, of which sessions share more
    FullProduct full_product_;
    std::vector<std::uint8_t> runs_looked_at_;     // of the operator; none: all
    TransportOperator::Weights renewing_weights_;  // none until a band has drifted
    std::uint32_t remaining_ = 0;
    double negligible_ = kSurelyNegligible;  // the part of the target that estimates leave out
    bool target_is_new_ = false;
    // The approximation was made exact without telling the stating and the choosing sketch.
    bool estimates_are_stale_ = false;
    bool exact_ = true;  // a session begins with a zero target and zero sums
};

}  // namespace relume::engine
