#include "server/engine/session.h"

#include <boost/container/small_vector.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

namespace relume::engine {
namespace {

// Rounding may leave at most this much of the image's norm before the total is made anew, which
// is cheap, or a band, which is not. The estimate takes errors for random; where a drag goes to
// and fro they repeat, and in dark pixels they are some ten times as large.
constexpr double kLargestDriftOfTotal = 3e-6;
constexpr double kLargestDriftOfBands = 5e-6;
// At rest the full product begins at once when it takes no longer than so many images.
constexpr std::uint64_t kImagesForFullProduct = 4;
// And where what is left cannot be seen, so that nobody waits for it in small steps.
constexpr double kUnseenError = 1e-3;

// The columns that sketches of the target leave out are to be so many times smaller than the
// error that these state. At most so much of the image, for the next error may be less than the
// last.
constexpr double kLeastTelling = 20;
// From one image to the next by so much before the sketches are made anew, which the budget
// does not foresee.
constexpr double kErrorMayFall = 8;
constexpr double kLargestNegligible = 5e-4;

// And where so many sessions rest together: they have all of the transport in common then, and
// little of what each would choose.
constexpr std::size_t kCompanyForFullProduct = 8;

// Without allocation, while no more are relit together than a sweep takes.
template <typename T>
using PerSession = boost::container::small_vector<T, kMaxBatchMembers>;

class Stopwatch {
  public:
    [[nodiscard]] double milliseconds() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace

Session::Session(std::shared_ptr<const Scene> scene, relighting::Strategy strategy)
    : scene_(std::move(scene)),
      strategy_(strategy),
      lighting_(*scene_),
      lit_(*scene_),
      planner_(*scene_),
      images_(*scene_),
      error_(*scene_),
      full_product_(*scene_) {}

void Session::set_lighting(std::span<const float> coefficients) {
    lighting_.set_target(coefficients);
    full_product_.abandon();
    lighting_is_new_ = true;
    exact_ = false;
}

double Session::stated_error() const {
    return exact_ ? 0 : error_.relative_l2();
}

bool Session::at_rest(const relighting::Budget& budget) const {
    return exact_ || (!lighting_is_new_ && budget.target_error > 0 &&
                      error_.relative_l2() <= budget.target_error);
}

StepReport Session::advance(const relighting::Budget& budget) {
    SessionTurn turn{.session = this, .budget = budget, .report = {}};
    advance_together({&turn, 1});
    return turn.report;
}

void Session::advance_together(std::span<SessionTurn> turns) {
    PerSession<Intent> intents(turns.size());
    tbb::parallel_for(std::size_t{0}, turns.size(), [&](std::size_t i) {
        // Times what it does: others' work must not slip in between.
        tbb::this_task_arena::isolate([&] {
            intents[i] = turns[i].session->intend(
                {.budget = turns[i].budget,
                 .sessions = turns.size(),
                 .ceiling_milliseconds = turns[i].ceiling_milliseconds});
        });
    });
    PerSession<PlannedTurn> planned;
    PerSession<SessionTurn*> products;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        turns[i].report = {};
        if (intents[i].deed == Deed::plan) {
            planned.push_back({turns[i].session, intents[i].plan, &turns[i].report});
        } else if (intents[i].deed == Deed::full_product) {
            products.push_back(&turns[i]);
        }
    }
    carry_out(std::span(planned.data(), planned.size()));
    advance_full_products(std::span(products.data(), products.size()), turns.size());
    for (SessionTurn& turn : turns) {
        turn.session->state(turn.report);
    }
}

StepReport Session::advance_incrementally(const SelectionBudget& budget) {
    StepReport report;
    if (!exact_) {
        const PlannedTurn turn{this, &next_plan(budget), &report};
        carry_out({&turn, 1});
    }
    state(report);
    return report;
}

void Session::state(StepReport& report) const {
    report.remaining = exact_ ? 0 : remaining_;
    report.exact = exact_;
    report.stated_error = stated_error();
    report.band_bytes = images_.bytes_of_bands();
}

Session::Intent Session::intend(const Share& share) {
    if (at_rest(share.budget)) {
        return {};
    }
    if (lighting_is_new_ ? shows_lighting_before() || full_product_fits_one_image(share)
                         : full_product_is_next(share)) {
        return {.deed = Deed::full_product, .plan = nullptr};
    }
    return {.deed = Deed::plan, .plan = &next_plan(selection_budget(share))};
}

const Plan& Session::next_plan(const SelectionBudget& budget) {
    const Stopwatch stopwatch;
    if (!lighting_is_new_) {
        const Plan& plan = planner_.go_on(lighting_, strategy_, budget);
        cost_.record_overhead(stopwatch.milliseconds());
        return plan;
    }
    lighting_is_new_ = false;
    double expected_error = error_.relative_l2();
    if (estimates_are_stale_) {
        expected_error = 0;
        lit_.set(lighting_.approximation());
        error_.set_approximation(lit_);
        planner_.approximation_is_unknown();
        estimates_are_stale_ = false;
    }
    set_target_of_estimates(expected_error);
    const Plan& plan = planner_.begin(lighting_, lit_, strategy_, budget);
    cost_.record_overhead(stopwatch.milliseconds());
    return plan;
}

SelectionBudget Session::selection_budget(const Share& share) const {
    if (share.budget.coefficients) {
        const std::uint64_t all = scene_->transport().total_bytes();
        const bool ceiled = std::isfinite(share.ceiling_milliseconds);
        return {.columns = *share.budget.coefficients,
                .bytes = ceiled ? std::min(all, cost_.bytes_within(share.ceiling_milliseconds,
                                                                   share.sessions))
                                : all};
    }
    const double milliseconds =
        std::min(share.budget.milliseconds.value_or(0), share.ceiling_milliseconds);
    return {.columns = static_cast<std::uint32_t>(scene_->coefficient_count()),
            .bytes = cost_.bytes_within(milliseconds, share.sessions)};
}

void Session::carry_out(std::span<const PlannedTurn> turns) {
    const Stopwatch stopwatch;
    std::uint64_t bytes = 0;
    for (std::size_t first = 0; first < turns.size(); first += kMaxBatchMembers) {
        const auto batch =
            turns.subspan(first, std::min(kMaxBatchMembers, turns.size() - first));
        PerSession<BandImages::Update> updates;
        for (const PlannedTurn& turn : batch) {
            updates.push_back({.images = &turn.session->images_,
                               .bands_to_clear = turn.plan->bands_to_reset,
                               .changes = turn.plan->changes});
        }
        BandImages::update_together(std::span(updates.data(), updates.size()));
        for (const PlannedTurn& turn : batch) {
            bytes += turn.session->images_.bytes_added();
        }
    }
    const double taken = stopwatch.milliseconds();
    for (const PlannedTurn& turn : turns) {
        turn.session->cost_.record_columns(bytes, taken);
    }
    tbb::parallel_for(std::size_t{0}, turns.size(), [&](std::size_t i) {
        turns[i].session->plan_is_carried_out(*turns[i].plan, *turns[i].report);
    });
}

void Session::set_target_of_estimates(double expected_error) {
    negligible_ = std::clamp(expected_error / (kErrorMayFall * kLeastTelling),
                             kSurelyNegligible, kLargestNegligible);
    lit_.set_nearly(lighting_.target(), negligible_);
    error_.set_target(lit_);
}

void Session::refine_estimates() {
    while (negligible_ > kSurelyNegligible &&
           error_.relative_l2() < kLeastTelling * negligible_) {
        set_target_of_estimates(error_.relative_l2());
    }
}

void Session::plan_is_carried_out(const Plan& plan, StepReport& report) {
    lighting_.apply(plan);
    error_.apply(plan);
    planner_.apply(plan);
    refine_estimates();
    remaining_ = plan.remaining_columns();
    report.applied = static_cast<std::uint32_t>(plan.changes.size());
    report.bands_reset = plan.bands_to_reset;
    report.bytes_touched += images_.bytes_added();
    report.image_changed = plan.bands_to_reset != 0 || !plan.changes.empty();
    remove_drift(report);
}

void Session::remove_drift(StepReport& report) {
    const double shown = error_.shown_norm();
    if (images_.rounding_error_of_total() > kLargestDriftOfTotal * shown) {
        images_.renew_total();
    }
    if (images_.rounding_error_of_bands() <= kLargestDriftOfBands * shown) {
        return;
    }
    const std::uint32_t band = images_.most_drifted_band();
    scene_->strips().set_weights(scene_->transport(), lighting_.approximation(),
                                 renewing_weights_);
    images_.renew_band(band, renewing_weights_);
    for (const std::uint32_t column : scene_->columns_of_band(band)) {
        report.bytes_touched += scene_->transport().column_bytes(column);
    }
}

std::uint64_t Session::product_bytes_per_image(const Share& share) const {
    if (share.budget.coefficients) {
        return scene_->strips().bytes() / scene_->coefficient_count() *
               *share.budget.coefficients;
    }
    return product_cost_.bytes_within(share.budget.milliseconds.value_or(0), share.sessions);
}

std::uint64_t Session::product_bytes_per_slice(const Share& share) const {
    const std::uint64_t bytes = product_bytes_per_image(share);
    return std::isfinite(share.ceiling_milliseconds)
               ? std::min(bytes, product_cost_.bytes_within(share.ceiling_milliseconds,
                                                            share.sessions))
               : bytes;
}

bool Session::full_product_is_next(const Share& share) const {
    if (full_product_.running() || remaining_ == 0 ||
        share.sessions >= kCompanyForFullProduct || error_.relative_l2() <= kUnseenError) {
        return true;
    }
    return scene_->strips().bytes() <= kImagesForFullProduct * product_bytes_per_image(share);
}

// Exact images while dragging: nothing is then chosen or estimated.
bool Session::full_product_fits_one_image(const Share& share) const {
    return !share.budget.coefficients &&
           scene_->strips().bytes() <= product_bytes_per_image(share);
}

void Session::advance_full_products(std::span<SessionTurn* const> turns, std::size_t sessions) {
    if (turns.empty()) {
        return;
    }
    PerSession<FullProduct*> products;
    std::uint64_t slice_bytes = 0;
    double ceiling = std::numeric_limits<double>::infinity();
    for (const SessionTurn* turn : turns) {
        products.push_back(&turn->session->full_product_);
        slice_bytes =
            std::max(slice_bytes, turn->session->product_bytes_per_slice(
                                      {.budget = turn->budget,
                                       .sessions = sessions,
                                       .ceiling_milliseconds = turn->ceiling_milliseconds}));
        ceiling = std::min(ceiling, turn->ceiling_milliseconds);
    }
    // Those that begin do so where another stands, to be swept together.
    const auto runs =
        std::find_if(products.begin(), products.end(),
                     [](const FullProduct* product) { return product->running(); });
    const std::uint32_t first_block = runs == products.end() ? 0 : (*runs)->next_block();
    for (std::size_t i = 0; i < turns.size(); ++i) {
        if (!products[i]->running()) {
            products[i]->start(turns[i]->session->lighting_.target(), first_block);
        }
    }
    const Stopwatch stopwatch;
    std::uint64_t bytes = 0;
    const auto somebody_waits_for_all = [&] {
        return std::any_of(turns.begin(), turns.end(), [](const SessionTurn* turn) {
            return turn->session->lighting_is_new_ && turn->session->full_product_.running();
        });
    };
    do {
        products.erase(
            std::remove_if(products.begin(), products.end(),
                           [](const FullProduct* product) { return !product->running(); }),
            products.end());
        bytes += FullProduct::advance_together(std::span(products.data(), products.size()),
                                               slice_bytes);
    } while (somebody_waits_for_all() && stopwatch.milliseconds() < ceiling);
    const double taken = stopwatch.milliseconds();
    for (SessionTurn* turn : turns) {
        turn->session->product_cost_.record_columns(bytes, taken);
        turn->report.bytes_touched += bytes / turns.size();
        if (!turn->session->full_product_.running()) {
            turn->session->full_product_is_done(turn->report);
        }
    }
}

void Session::full_product_is_done(StepReport& report) {
    full_product_.exchange(images_);
    if (lighting_is_new_) {
        estimates_are_stale_ = true;
        report.applied = static_cast<std::uint32_t>(scene_->coefficient_count());
    } else {
        lit_.set(lighting_.target());
        error_.approximation_is_target(lit_);
        planner_.approximation_is_target(lit_);
        report.applied = remaining_;
    }
    lighting_is_new_ = false;
    remaining_ = 0;
    lighting_.apply_all();
    exact_ = true;
    report.image_changed = true;
}

void Session::write_image(std::span<float> rgb) const {
    write_relit_image(*scene_, images_.total(), rgb);
}

void Session::write_tiles(const TileRun& tiles, std::span<float> rgb) const {
    write_relit_tiles(*scene_, images_.total(), tiles, rgb);
}

}  // namespace relume::engine
