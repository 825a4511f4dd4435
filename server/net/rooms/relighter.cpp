#include "server/net/rooms/relighter.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace relume::net {

namespace {

view::Look look_of(const wire::RoomState& state) {
    return {.eye = state.camera.eye,
            .look_at = state.camera.look_at,
            .up = state.camera.up,
            .fov_degrees = state.camera.fov_degrees,
            .width = state.image.width,
            .height = state.image.height};
}

}  // namespace

Relighter::Relighter(std::shared_ptr<const ServedScene> scene,
                     Metrics& metrics,
                     Clock::duration ceiling)
    : scene_(std::move(scene)),
      metrics_(metrics),
      session_(scene_->loaded->workspace(), relighting::Strategy{}),
      composer_(std::make_shared<FrameComposer>(scene_->loaded->make_view(), scene_->sky)),
      signal_(make_signal(*scene_->loaded)),
      budget_(milliseconds(ceiling)) {}

std::vector<wire::ErrorMessage> Relighter::set_state(const wire::RoomState& state,
                                                     const NamedEnvironments& environments,
                                                     wire::Stages stages) {
    const Clock::time_point begin = Clock::now();
    std::vector<wire::ErrorMessage> problems;
    if (!state_) {
        stages = kAllStages;
    }
    const bool signal_is_new =
        stages.has(wire::Stage::signal) && signal_->set_state(state, environments, problems);
    if (signal_is_new) {
        session_.set_target(signal_->coefficients());
        pixels_changed();
    }
    const bool sees_environment = state.background.mode == wire::BackgroundMode::environment;
    if (stages.has(wire::Stage::view) && (composer_->look(look_of(state)) || !state_)) {
        tell_session_what_counts();
    }
    if (stages.has(wire::Stage::view) || (signal_is_new && sees_environment)) {
        composer_->set_background(state.background, signal_->rig());
        pixels_changed();
    }
    if (stages.has(wire::Stage::policy)) {
        session_.set_strategy(state.strategy);
    }
    if (stages.has(wire::Stage::display)) {
        image_changed_ = true;
    }
    state_ = state;
    if (signal_is_new) {
        const Clock::duration spent = Clock::now() - begin;
        metrics_.observe_lighting(seconds(spent));
        budget_.begin_step(milliseconds(spent));
        relight_time_ += spent;
    }
    return problems;
}

// What has not counted is brought up to date where it counts now; an exact image is so already.
void Relighter::tell_session_what_counts() {
    const std::vector<float> weights = composer_->block_weights();
    if (weights.empty()) {
        return;
    }
    session_.set_block_weights(weights);
    if (!session_.exact()) {
        composer_->sums_have_changed();
    }
}

void Relighter::pixels_changed() {
    ++pixels_;
    image_changed_ = true;
}

void Relighter::advance_together(std::span<Relighter* const> relighters) {
    const Clock::time_point begin = Clock::now();
    std::vector<engine::SessionStep> slices;
    for (Relighter* relighter : relighters) {
        slices.push_back({.session = &relighter->session_,
                          .budget = relighter->budget_.for_slice(relighter->state_->budget,
                                                                 relighters.size()),
                          .ceiling_milliseconds = relighter->budget_.ceiling_ms(),
                          .report = {}});
    }
    engine::Session::advance_together(slices);
    const Clock::duration spent = Clock::now() - begin;
    for (std::size_t i = 0; i < slices.size(); ++i) {
        relighters[i]->relit(slices[i].report, spent);
    }
}

void Relighter::relit(const engine::StepReport& report, Clock::duration spent) {
    metrics_.count_slice(report, seconds(spent));
    budget_.slice_took(milliseconds(spent), report.applied);
    relight_time_ += spent;
    applied_ += report.applied;
    remaining_ = report.remaining;
    if (report.image_changed) {
        composer_->sums_have_changed();
        pixels_changed();
    }
}

bool Relighter::step_is_complete() const {
    return at_rest() || (!shows_state_before() && budget_.is_spent(state_->budget));
}

void Relighter::compose(const ImageForms& forms, bool settled) {
    const Clock::time_point begin = Clock::now();
    composer_->compose(session_.sums(), displays_.of(forms.displays, state_->display),
                       forms.half_planes);
    const Clock::duration spent = Clock::now() - begin;
    metrics_.observe_compose(seconds(spent));
    if (!settled) {
        budget_.composing_took(milliseconds(spent));
    }
}

Picture Relighter::picture(const ImageStamp& stamp, const ImageForms& forms, int jpeg_quality) {
    if (stamp.settled && composer_->look_closer()) {
        tell_session_what_counts();
        composer_->set_background(state_->background, signal_->rig());
    }
    compose(forms, stamp.settled);
    const bool exact = session_.exact();
    Picture picture{
        .header = {.encoding = {},
                   .width = composer_->width(),
                   .height = composer_->height(),
                   .revision = stamp.revision,
                   .sequence = stamp.sequence,
                   .relative_error = exact ? 0.0F : static_cast<float>(session_.stated_error()),
                   .exact = exact,
                   .has_alpha = false,
                   .edit_to_image_ms =
                       static_cast<float>(milliseconds(Clock::now() - stamp.edit_read_at)),
                   .relight_ms = static_cast<float>(milliseconds(relight_time_)),
                   .encode_ms = 0,
                   .coefficients_applied = applied_,
                   .payload_bytes = 0,
                   .coefficients_remaining = exact ? 0 : remaining_},
        .has_alpha = composer_->has_alpha(),
        .settled = stamp.settled,
        .forms = forms,
        .jpeg_quality = jpeg_quality,
        .composer = composer_};
    image_changed_ = false;
    relight_time_ = {};
    applied_ = 0;
    return picture;
}

}  // namespace relume::net
