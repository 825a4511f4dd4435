#include "tests/lab/methods/session_contestant.h"

#include "protocol/relighting/strategy.h"
#include "tests/lab/methods/light_radiance.h"

#include <algorithm>
#include <utility>

namespace relume::lab {

SessionContestant::SessionContestant(std::shared_ptr<const served::Scene> scene,
                                     relighting::Strategy strategy,
                                     const engine::SelectionBudget& budget,
                                     std::size_t coefficients)
    : scene_(std::move(scene)),
      session_(scene_->workspace(), strategy), budget_(budget), coefficients_(coefficients) {}

void SessionContestant::set_light(const ImageLight& light) {
    light::lighting_coefficients(light.radiance, scene_->projection(), target_);
    const std::size_t count = scene_->columns().count();
    for (std::size_t first = 0; first < target_.size(); first += count) {
        std::fill(target_.begin() + static_cast<std::ptrdiff_t>(first + coefficients_),
                  target_.begin() + static_cast<std::ptrdiff_t>(first + count), 0.0F);
    }
    session_.set_target(target_);
}

Step SessionContestant::step() {
    const engine::StepReport report = session_.advance_incrementally(budget_);
    return {.applied = report.applied,
            .bands_reset = report.bands_reset,
            .bytes = report.bytes_touched,
            .band_bytes = report.band_bytes,
            .stated_error = report.stated_error};
}

LightingView SessionContestant::lighting() const {
    return {.target = target_,
            .approximation = session_.approximation(),
            .bands = scene_->columns().bands()};
}

void SessionContestant::write_radiance(light::LightCubemap& out) const {
    radiance_from_coefficients(session_.approximation(), scene_->projection(), out);
}

}  // namespace relume::lab
