#include "server/engine/session.h"

#include "server/engine/relit_image.h"

#include <chrono>
#include <utility>

namespace relume::engine {
namespace {

// Rounding may leave at most this much of the image's norm before the drifted band is made
// anew.
constexpr double kLargestDrift = 1e-5;
// At rest the full product begins at once when it takes no longer than so many images.
constexpr std::uint64_t kImagesForFullProduct = 4;

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

Session::Session(std::shared_ptr<const Scene> scene, wire::Strategy strategy)
    : scene_(std::move(scene)),
      strategy_(strategy),
      lighting_(*scene_),
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

bool Session::at_rest(const wire::Budget& budget) const {
    return exact_ || (!lighting_is_new_ && budget.target_error > 0 &&
                      error_.relative_l2() <= budget.target_error);
}

StepReport Session::advance(const wire::Budget& budget) {
    StepReport report;
    if (!at_rest(budget)) {
        if (lighting_is_new_ ? full_product_fits_one_image(budget)
                             : full_product_is_next(budget)) {
            advance_full_product(budget, report);
        } else {
            carry_out(next_plan(selection_budget(budget)), report);
        }
    }
    state(report);
    return report;
}

StepReport Session::advance_incrementally(const SelectionBudget& budget) {
    StepReport report;
    if (!exact_) {
        carry_out(next_plan(budget), report);
    }
    state(report);
    return report;
}

void Session::state(StepReport& report) const {
    report.remaining = exact_ ? 0 : remaining_;
    report.exact = exact_;
    report.stated_error = stated_error();
}

const Plan& Session::next_plan(const SelectionBudget& budget) {
    if (!lighting_is_new_) {
        return planner_.go_on(lighting_, strategy_, budget);
    }
    const Stopwatch stopwatch;
    lighting_is_new_ = false;
    if (estimates_are_stale_) {
        error_.set_approximation(lighting_.approximation());
        planner_.approximation_is_unknown();
        estimates_are_stale_ = false;
    }
    error_.set_target(lighting_.target());
    const Plan& plan = planner_.begin(lighting_, strategy_, budget);
    cost_.record_overhead(stopwatch.milliseconds());
    return plan;
}

SelectionBudget Session::selection_budget(const wire::Budget& budget) const {
    if (budget.coefficients) {
        return {.columns = *budget.coefficients, .bytes = scene_->transport().total_bytes()};
    }
    return {.columns = static_cast<std::uint32_t>(scene_->coefficient_count()),
            .bytes = cost_.bytes_within(budget.milliseconds.value_or(0))};
}

void Session::carry_out(const Plan& plan, StepReport& report) {
    const Stopwatch stopwatch;
    images_.update(plan.bands_to_reset, plan.changes);
    cost_.record_columns(plan.bytes, stopwatch.milliseconds());
    lighting_.apply(plan);
    error_.apply(plan);
    planner_.apply(plan);
    remaining_ = plan.remaining_columns();
    report.applied = static_cast<std::uint32_t>(plan.changes.size());
    report.bands_reset = plan.bands_to_reset;
    report.bytes_touched += plan.bytes;
    report.image_changed = plan.bands_to_reset != 0 || !plan.changes.empty();
    remove_drift(report);
}

void Session::remove_drift(StepReport& report) {
    if (images_.rounding_error() <= kLargestDrift * error_.shown_norm()) {
        return;
    }
    const std::uint32_t band = images_.most_drifted_band();
    std::vector<ColumnChange> all;
    gather_columns(*scene_, lighting_.approximation(), all);
    const auto columns = changes_of_band(all, scene_->bands(), band);
    images_.update(1U << band, columns);
    for (const ColumnChange& column : columns) {
        report.bytes_touched += scene_->transport().column_bytes(column.column);
    }
}

std::uint64_t Session::bytes_per_image(const wire::Budget& budget) const {
    if (budget.coefficients) {
        return scene_->transport().total_bytes() / scene_->coefficient_count() *
               *budget.coefficients;
    }
    return cost_.bytes_within(budget.milliseconds.value_or(0));
}

bool Session::full_product_is_next(const wire::Budget& budget) const {
    if (full_product_.running() || remaining_ == 0) {
        return true;
    }
    return scene_->transport().total_bytes() <= kImagesForFullProduct * bytes_per_image(budget);
}

// Exact images while dragging: nothing is then chosen or estimated.
bool Session::full_product_fits_one_image(const wire::Budget& budget) const {
    return !budget.coefficients && scene_->transport().total_bytes() <= bytes_per_image(budget);
}

void Session::advance_full_product(const wire::Budget& budget, StepReport& report) {
    if (!full_product_.running()) {
        full_product_.start(lighting_.target());
    }
    const Stopwatch stopwatch;
    std::uint64_t bytes = 0;
    do {
        bytes += full_product_.advance(bytes_per_image(budget));
    } while (lighting_is_new_ && full_product_.running());
    cost_.record_columns(bytes, stopwatch.milliseconds());
    report.bytes_touched += bytes;
    if (full_product_.running()) {
        return;
    }
    full_product_.exchange(images_);
    if (lighting_is_new_) {
        estimates_are_stale_ = true;
        report.applied = static_cast<std::uint32_t>(scene_->coefficient_count());
    } else {
        error_.approximation_is_target();
        planner_.approximation_is_target();
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

}  // namespace relume::engine
