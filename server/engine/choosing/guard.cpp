#include "server/engine/choosing/guard.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace relume::engine {
namespace {

// To weigh a candidate costs in proportion to the shortlist. Beyond so many places the image
// itself is near the target whatever begins anew, and only the first three are weighed.
constexpr std::size_t kLongestSearched = 4096;

}  // namespace

Guard::Guard(const ColumnTable& table)
    : table_(&table),
      sketch_(&table.choosing_sketch()),
      shown_(table),
      target_(table, *sketch_),
      approximation_(target_),
      last_target_(target_.size()) {}

const Plan& Guard::decide(const SignalState& signal,
                          const SignificantColumns& significant,
                          Ranking& ranking,
                          const SelectionBudget& budget) {
    const bool rests = set_target(significant);
    if (!approximation_known_) {
        shown_.set(signal.approximation());
        approximation_.set(shown_);
        approximation_known_ = true;
    }
    standing_error_ = predicted_error({});
    ranking.shortlist(*table_, budget, shortlist_);
    candidate_count_ = 0;
    weighed_count_ = 0;
    best_ = 0;
    propose(0);
    if (!rests) {
        propose(ranking.bands_nearer_from_nothing());
        propose((1U << table_->band_count()) - 1);
    }
    weigh_new(signal, ranking, budget);
    if (!rests && shortlist_.size() <= kLongestSearched) {
        search_nearby(signal, ranking, budget);
    }
    return candidates_[best_].plan;
}

bool Guard::set_target(const SignificantColumns& significant) {
    for (std::size_t r = 0; r < target_.size(); ++r) {
        last_target_[r] = target_.sum(r);
    }
    target_.set(significant);
    for (std::size_t r = 0; r < target_.size(); ++r) {
        if (target_.sum(r) != last_target_[r]) {
            return false;
        }
    }
    return true;
}

void Guard::search_nearby(const SignalState& signal,
                          const Ranking& ranking,
                          const SelectionBudget& budget) {
    std::size_t last_best = candidate_count_;
    while (best_ != last_best) {
        last_best = best_;
        const std::uint32_t bands_to_reset = candidates_[best_].plan.bands_to_reset;
        for (std::uint32_t band = 0; band < table_->band_count(); ++band) {
            propose(bands_to_reset ^ (1U << band));
        }
        weigh_new(signal, ranking, budget);
    }
}

void Guard::propose(std::uint32_t bands_to_reset) {
    for (const Candidate& other : candidates()) {
        if (other.plan.bands_to_reset == bands_to_reset) {
            return;
        }
    }
    if (candidate_count_ == candidates_.size()) {
        candidates_.emplace_back();
    }
    candidates_[candidate_count_].plan.bands_to_reset = bands_to_reset;
    ++candidate_count_;
}

void Guard::weigh_new(const SignalState& signal,
                      const Ranking& ranking,
                      const SelectionBudget& budget) {
    tbb::parallel_for(weighed_count_, candidate_count_, [&](std::size_t i) {
        Candidate& candidate = candidates_[i];
        selections_.local().choose(*table_, signal, ranking, shortlist_, budget,
                                   candidate.plan);
        candidate.predicted_error = predicted_error(candidate.plan);
    });
    for (std::size_t i = weighed_count_; i < candidate_count_; ++i) {
        if (is_better(candidates_[i], candidates_[best_])) {
            best_ = i;
        }
    }
    weighed_count_ = candidate_count_;
}

bool Guard::is_better(const Candidate& candidate, const Candidate& than) const {
    // Rounding must not pass for an improvement.
    constexpr double kNearer = 0.999;
    const bool eligible = candidate.plan.bands_to_reset == 0 ||
                          candidate.predicted_error < kNearer * standing_error_;
    return eligible && candidate.predicted_error < than.predicted_error;
}

double Guard::predicted_error(const Plan& plan) const {
    const std::size_t size = target_.band(0).size();
    thread_local std::vector<float> added;
    added.assign(size, 0);
    add_sketch(*sketch_, plan.changes, added);
    double squared = 0;
    for (std::size_t i = 0; i < size; ++i) {
        double residual = -double{added[i]};
        for (std::uint32_t band = 0; band < table_->band_count(); ++band) {
            residual += target_.band(band)[i];
            residual -= plan.resets(band) ? 0 : approximation_.band(band)[i];
        }
        squared += target_.row_weight(i) * residual * residual;
    }
    return std::sqrt(squared);
}

void Guard::apply(const Plan& plan) {
    if (approximation_known_) {
        approximation_.apply(plan);
    }
}

void Guard::approximation_is_target(const SignificantColumns& target) {
    if (approximation_known_) {
        target_.set(target);
        approximation_ = target_;
    }
}

}  // namespace relume::engine
