#include "server/engine/session.h"

#include "protocol/base/timing/stopwatch.h"

#include <boost/container/small_vector.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
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

}  // namespace

Session::Session(std::shared_ptr<const Workspace> workspace, relighting::Strategy strategy)
    : workspace_(std::move(workspace)),
      strategy_(strategy),
      signal_(workspace_->columns()),
      significant_(workspace_->columns()),
      planner_(workspace_->columns()),
      sums_(workspace_->transport_operator()),
      error_(workspace_->columns()),
      full_product_(workspace_->transport_operator(), workspace_->spare_sums()) {}

void Session::set_target(std::span<const float> coefficients) {
    signal_.set_target(coefficients);
    full_product_.abandon();
    target_is_new_ = true;
    exact_ = false;
}

void Session::set_block_weights(std::span<const float> weights) {
    error_.set_block_weights(weights);
    planner_.set_block_weights(weights);
    const TransportOperator& of = workspace_->transport_operator();
    runs_looked_at_.assign(of.run_count(), 0);
    for (std::size_t run = 0; run < of.run_count(); ++run) {
        const auto [first, count] = of.run(run);
        const auto blocks = weights.subspan(first, count);
        runs_looked_at_[run] =
            std::any_of(blocks.begin(), blocks.end(), [](float weight) { return weight > 0; })
                ? 1
                : 0;
    }
    sums_.look_at(runs_looked_at_, signal_.approximation());
}

double Session::stated_error() const {
    return exact_ ? 0 : error_.relative_l2();
}

bool Session::at_rest(const relighting::Budget& budget) const {
    return exact_ || (!target_is_new_ && budget.target_error > 0 &&
                      error_.relative_l2() <= budget.target_error);
}

StepReport Session::advance(const relighting::Budget& budget) {
    SessionStep step{.session = this, .budget = budget, .report = {}};
    advance_together({&step, 1});
    return step.report;
}

void Session::advance_together(std::span<SessionStep> steps) {
    PerSession<Decision> decisions(steps.size());
    tbb::parallel_for(std::size_t{0}, steps.size(), [&](std::size_t i) {
        // Times what it does: others' work must not slip in between.
        tbb::this_task_arena::isolate([&] {
            decisions[i] = steps[i].session->decide(
                {.budget = steps[i].budget,
                 .sessions = steps.size(),
                 .ceiling_milliseconds = steps[i].ceiling_milliseconds});
        });
    });
    PerSession<PlannedStep> planned;
    PerSession<SessionStep*> products;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        steps[i].report = {};
        if (decisions[i].work == Work::plan) {
            planned.push_back({steps[i].session, decisions[i].plan, &steps[i].report});
        } else if (decisions[i].work == Work::full_product) {
            products.push_back(&steps[i]);
        }
    }
    carry_out(std::span(planned.data(), planned.size()));
    advance_full_products(std::span(products.data(), products.size()), steps.size());
    for (SessionStep& step : steps) {
        step.session->state(step.report);
    }
}

StepReport Session::advance_incrementally(const SelectionBudget& budget) {
    StepReport report;
    if (!exact_) {
        const PlannedStep step{this, &next_plan(budget), &report};
        carry_out({&step, 1});
    }
    state(report);
    return report;
}

void Session::state(StepReport& report) const {
    report.remaining = exact_ ? 0 : remaining_;
    report.exact = exact_;
    report.stated_error = stated_error();
    report.band_bytes = sums_.bytes_of_bands();
}

Session::Decision Session::decide(const Allowance& allowance) {
    if (at_rest(allowance.budget)) {
        return {};
    }
    if (target_is_new_ ? shows_target_before() || full_product_fits_one_image(allowance)
                       : full_product_is_next(allowance)) {
        return {.work = Work::full_product, .plan = nullptr};
    }
    return {.work = Work::plan, .plan = &next_plan(selection_budget(allowance))};
}

const Plan& Session::next_plan(const SelectionBudget& budget) {
    const timing::Stopwatch stopwatch;
    if (!target_is_new_) {
        const Plan& plan = planner_.go_on(signal_, strategy_, budget);
        cost_.record_overhead(stopwatch.milliseconds());
        return plan;
    }
    target_is_new_ = false;
    double expected_error = error_.relative_l2();
    if (estimates_are_stale_) {
        expected_error = 0;
        significant_.set(signal_.approximation());
        error_.set_approximation(significant_);
        planner_.approximation_is_unknown();
        estimates_are_stale_ = false;
    }
    set_target_of_estimates(expected_error);
    const Plan& plan = planner_.begin(signal_, significant_, strategy_, budget);
    cost_.record_overhead(stopwatch.milliseconds());
    return plan;
}

SelectionBudget Session::selection_budget(const Allowance& allowance) const {
    if (allowance.budget.coefficients) {
        const std::uint64_t all = workspace_->columns().total_bytes();
        const bool ceiled = std::isfinite(allowance.ceiling_milliseconds);
        return {.columns = *allowance.budget.coefficients,
                .bytes = ceiled
                             ? std::min(all, cost_.bytes_within(allowance.ceiling_milliseconds,
                                                                allowance.sessions))
                             : all};
    }
    const double milliseconds =
        std::min(allowance.budget.milliseconds.value_or(0), allowance.ceiling_milliseconds);
    return {.columns = static_cast<std::uint32_t>(workspace_->columns().count()),
            .bytes = cost_.bytes_within(milliseconds, allowance.sessions)};
}

void Session::carry_out(std::span<const PlannedStep> steps) {
    const timing::Stopwatch stopwatch;
    std::uint64_t bytes = 0;
    for (std::size_t first = 0; first < steps.size(); first += kMaxBatchMembers) {
        const auto batch =
            steps.subspan(first, std::min(kMaxBatchMembers, steps.size() - first));
        PerSession<BandSums::Update> updates;
        for (const PlannedStep& step : batch) {
            updates.push_back({.sums = &step.session->sums_,
                               .bands_to_clear = step.plan->bands_to_reset,
                               .changes = step.plan->changes});
        }
        BandSums::update_together(std::span(updates.data(), updates.size()));
        for (const PlannedStep& step : batch) {
            bytes += step.session->sums_.bytes_added();
        }
    }
    const double taken = stopwatch.milliseconds();
    for (const PlannedStep& step : steps) {
        step.session->cost_.record_columns(bytes, taken);
    }
    tbb::parallel_for(std::size_t{0}, steps.size(), [&](std::size_t i) {
        steps[i].session->plan_is_carried_out(*steps[i].plan, *steps[i].report);
    });
}

void Session::set_target_of_estimates(double expected_error) {
    negligible_ = std::clamp(expected_error / (kErrorMayFall * kLeastTelling),
                             kSurelyNegligible, kLargestNegligible);
    significant_.set_nearly(signal_.target(), negligible_);
    error_.set_target(significant_);
}

void Session::refine_estimates() {
    while (negligible_ > kSurelyNegligible &&
           error_.relative_l2() < kLeastTelling * negligible_) {
        set_target_of_estimates(error_.relative_l2());
    }
}

void Session::plan_is_carried_out(const Plan& plan, StepReport& report) {
    signal_.apply(plan);
    error_.apply(plan);
    planner_.apply(plan);
    refine_estimates();
    remaining_ = plan.remaining_columns();
    report.applied = static_cast<std::uint32_t>(plan.changes.size());
    report.bands_reset = plan.bands_to_reset;
    report.bytes_touched += sums_.bytes_added();
    report.image_changed = plan.bands_to_reset != 0 || !plan.changes.empty();
    remove_drift(report);
}

void Session::remove_drift(StepReport& report) {
    const double shown = error_.shown_norm();
    if (sums_.rounding_error_of_total() > kLargestDriftOfTotal * shown) {
        sums_.renew_total();
    }
    if (sums_.rounding_error_of_bands() <= kLargestDriftOfBands * shown) {
        return;
    }
    const std::uint32_t band = sums_.most_drifted_band();
    workspace_->transport_operator().set_weights(signal_.approximation(), renewing_weights_);
    sums_.renew_band(band, renewing_weights_);
    for (const std::uint32_t column : workspace_->columns().of_band(band)) {
        report.bytes_touched += workspace_->columns().bytes(column);
    }
}

std::uint64_t Session::product_bytes_per_image(const Allowance& allowance) const {
    if (allowance.budget.coefficients) {
        return workspace_->transport_operator().product_bytes() /
               workspace_->columns().count() * *allowance.budget.coefficients;
    }
    return product_cost_.bytes_within(allowance.budget.milliseconds.value_or(0),
                                      allowance.sessions);
}

std::uint64_t Session::product_bytes_per_slice(const Allowance& allowance) const {
    const std::uint64_t bytes = product_bytes_per_image(allowance);
    return std::isfinite(allowance.ceiling_milliseconds)
               ? std::min(bytes, product_cost_.bytes_within(allowance.ceiling_milliseconds,
                                                            allowance.sessions))
               : bytes;
}

bool Session::full_product_is_next(const Allowance& allowance) const {
    if (full_product_.running() || remaining_ == 0 ||
        allowance.sessions >= kCompanyForFullProduct || error_.relative_l2() <= kUnseenError) {
        return true;
    }
    return workspace_->transport_operator().product_bytes() <=
           kImagesForFullProduct * product_bytes_per_image(allowance);
}

// Exact images while dragging: nothing is then chosen or estimated.
bool Session::full_product_fits_one_image(const Allowance& allowance) const {
    return !allowance.budget.coefficients && workspace_->transport_operator().product_bytes() <=
                                                 product_bytes_per_image(allowance);
}

void Session::advance_full_products(std::span<SessionStep* const> steps, std::size_t sessions) {
    if (steps.empty()) {
        return;
    }
    PerSession<FullProduct*> products;
    std::uint64_t slice_bytes = 0;
    double slice_milliseconds = 0;
    double ceiling = std::numeric_limits<double>::infinity();
    for (const SessionStep* step : steps) {
        products.push_back(&step->session->full_product_);
        slice_bytes =
            std::max(slice_bytes, step->session->product_bytes_per_slice(
                                      {.budget = step->budget,
                                       .sessions = sessions,
                                       .ceiling_milliseconds = step->ceiling_milliseconds}));
        slice_milliseconds =
            std::max(slice_milliseconds, std::min(step->budget.milliseconds.value_or(
                                                      std::numeric_limits<double>::infinity()),
                                                  step->ceiling_milliseconds));
        ceiling = std::min(ceiling, step->ceiling_milliseconds);
    }
    // Those that begin do so where another stands, to be swept together.
    const auto runs =
        std::find_if(products.begin(), products.end(),
                     [](const FullProduct* product) { return product->running(); });
    const std::uint32_t first_block = runs == products.end() ? 0 : (*runs)->next_block();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!products[i]->running()) {
            products[i]->start(steps[i]->session->signal_.target(), first_block);
        }
    }
    const timing::Stopwatch stopwatch;
    std::uint64_t bytes = 0;
    const auto somebody_waits_for_all = [&] {
        return std::any_of(steps.begin(), steps.end(), [](const SessionStep* step) {
            return step->session->target_is_new_ && step->session->full_product_.running();
        });
    };
    // A byte may cost ten times as much in one part of the image as in another. So a slice is
    // taken in parts, and none begins when the slice's time is over.
    constexpr std::uint64_t kParts = 8;
    const auto slice_goes_on = [&] {
        return bytes < slice_bytes * steps.size() &&
               stopwatch.milliseconds() < slice_milliseconds;
    };
    do {
        bytes += FullProduct::advance_together(std::span(products.data(), products.size()),
                                               slice_bytes / kParts);
        products.erase(
            std::remove_if(products.begin(), products.end(),
                           [](const FullProduct* product) { return !product->running(); }),
            products.end());
    } while (!products.empty() && (slice_goes_on() || (somebody_waits_for_all() &&
                                                       stopwatch.milliseconds() < ceiling)));
    const double taken = stopwatch.milliseconds();
    for (SessionStep* step : steps) {
        step->session->product_cost_.record_columns(bytes, taken);
        step->report.bytes_touched += bytes / steps.size();
        if (!step->session->full_product_.running()) {
            step->session->full_product_is_done(step->report);
        }
    }
}

void Session::full_product_is_done(StepReport& report) {
    full_product_.exchange(sums_);
    if (!runs_looked_at_.empty()) {
        sums_.look_at(runs_looked_at_, signal_.approximation());
    }
    if (target_is_new_) {
        estimates_are_stale_ = true;
        report.applied = static_cast<std::uint32_t>(workspace_->columns().count());
    } else {
        significant_.set(signal_.target());
        error_.approximation_is_target(significant_);
        planner_.approximation_is_target(significant_);
        report.applied = remaining_;
    }
    target_is_new_ = false;
    remaining_ = 0;
    signal_.apply_all();
    exact_ = true;
    report.image_changed = true;
}

}  // namespace relume::engine
