#include "tests/lab/methods/session_contestant.h"

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "tests/lab/methods/light_radiance.h"

#include <algorithm>
#include <utility>

namespace relume::lab {

SessionContestant::SessionContestant(SessionParts parts,
                                     relighting::Strategy strategy,
                                     const std::optional<engine::SelectionBudget>& budget,
                                     std::size_t coefficients)
    : scene_(std::move(parts.scene)),
      image_(std::move(parts.image)),
      session_(std::move(parts.workspace), strategy),
      budget_(budget),
      coefficients_(coefficients) {
    weigh_blocks();
}

void SessionContestant::weigh_blocks() {
    const std::vector<float> weights = image_->block_weights();
    if (!weights.empty()) {
        session_.set_block_weights(weights);
    }
}

void SessionContestant::look(const view::Look& look) {
    if (image_->look(look)) {
        weigh_blocks();
    }
}

void SessionContestant::set_light(const ImageLight& light) {
    light::lighting_coefficients(light.radiance, scene_->projection(), target_);
    const std::size_t count = scene_->columns().count();
    for (std::size_t first = 0; first < target_.size(); first += count) {
        std::fill(target_.begin() + static_cast<std::ptrdiff_t>(first + coefficients_),
                  target_.begin() + static_cast<std::ptrdiff_t>(first + count), 0.0F);
    }
    session_.set_target(target_);
}

engine::StepReport SessionContestant::advance() {
    constexpr relighting::Budget kAllAtOnce{
        .milliseconds = 1e6, .coefficients = std::nullopt, .target_error = 0};
    return budget_ ? session_.advance_incrementally(*budget_) : session_.advance(kAllAtOnce);
}

Step SessionContestant::step() {
    const engine::StepReport report = advance();
    const std::uint64_t bytes_of_image = image_->take(session_.sums());
    return {.applied = report.applied,
            .bands_reset = report.bands_reset,
            .bytes = report.bytes_touched + bytes_of_image,
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

std::unique_ptr<Contestant> session_over(const std::shared_ptr<const served::Scene>& scene,
                                         relighting::Strategy strategy,
                                         const std::optional<engine::SelectionBudget>& budget,
                                         std::size_t coefficients) {
    return std::make_unique<SessionContestant>(
        SessionParts{.scene = scene,
                     .workspace = scene->workspace(),
                     .image = std::make_unique<ViewImageMaker>(*scene)},
        strategy, budget, coefficients);
}

}  // namespace relume::lab
