#include "server/engine/guard.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace relume::engine {

Guard::Guard(const Scene& scene)
    : scene_(&scene),
      sketch_(&scene.transport().choosing_sketch()),
      target_(scene, *sketch_),
      approximation_(target_),
      candidates_(kMostCandidates),
      selections_(kMostCandidates) {}

const Plan& Guard::decide(const Lighting& lighting,
                          const Ranking& ranking,
                          const SelectionBudget& budget) {
    target_.set(lighting.target());
    if (!approximation_known_) {
        approximation_.set(lighting.approximation());
        approximation_known_ = true;
    }
    candidate_count_ = 0;
    propose(0);
    propose(ranking.bands_nearer_from_nothing());
    propose(bands_fainter_from_nothing());
    propose((1U << scene_->band_count()) - 1);
    tbb::parallel_for(std::size_t{0}, candidate_count_, [&](std::size_t i) {
        Candidate& candidate = candidates_[i];
        selections_[i].choose(*scene_, lighting, ranking, budget, candidate.plan);
        candidate.predicted_error = predicted_error(candidate.plan);
    });
    return std::min_element(candidates_.begin(),
                            candidates_.begin() + static_cast<std::ptrdiff_t>(candidate_count_),
                            [](const Candidate& a, const Candidate& b) {
                                return a.predicted_error < b.predicted_error;
                            })
        ->plan;
}

void Guard::propose(std::uint32_t bands_to_reset) {
    for (const Candidate& other : candidates()) {
        if (other.plan.bands_to_reset == bands_to_reset) {
            return;
        }
    }
    candidates_[candidate_count_].plan.bands_to_reset = bands_to_reset;
    ++candidate_count_;
}

// The image-space twin of PBI's criterion: ‖T_b L_b‖ < ‖T_b (L_b − L̃_b)‖.
std::uint32_t Guard::bands_fainter_from_nothing() const {
    std::uint32_t mask = 0;
    for (std::uint32_t band = 0; band < scene_->band_count(); ++band) {
        const auto target = target_.band(band);
        const auto approximation = approximation_.band(band);
        double from_nothing = 0;
        double as_shown = 0;
        for (std::size_t i = 0; i < target.size(); ++i) {
            const double difference = target[i] - approximation[i];
            from_nothing += target[i] * target[i];
            as_shown += difference * difference;
        }
        mask |= from_nothing < as_shown ? 1U << band : 0U;
    }
    return mask;
}

double Guard::predicted_error(const Plan& plan) const {
    const std::size_t size = target_.band(0).size();
    thread_local std::vector<float> added;
    added.assign(size, 0);
    add_sketch(*sketch_, plan.changes, added);
    double squared = 0;
    for (std::size_t i = 0; i < size; ++i) {
        double residual = -double{added[i]};
        for (std::uint32_t band = 0; band < scene_->band_count(); ++band) {
            residual += target_.band(band)[i];
            residual -= plan.resets(band) ? 0 : approximation_.band(band)[i];
        }
        squared += residual * residual;
    }
    return std::sqrt(squared);
}

void Guard::apply(const Plan& plan) {
    if (approximation_known_) {
        approximation_.apply(plan);
    }
}

void Guard::approximation_is_target() {
    if (approximation_known_) {
        approximation_ = target_;
    }
}

}  // namespace relume::engine
