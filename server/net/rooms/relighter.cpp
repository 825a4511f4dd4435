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
                     Clock::duration ceiling,
                     std::size_t material_bytes)
    : scene_(std::move(scene)),
      metrics_(metrics),
      session_(scene_->loaded->workspace(), relighting::Strategy{}),
      layer_(make_layer(scene_->loaded, material_bytes)),
      composer_(std::make_shared<FrameComposer>(
          layer_ ? layer_->make_view() : scene_->loaded->make_view(), scene_->sky)),
      signal_(make_signal(*scene_->loaded)),
      budget_(milliseconds(ceiling)) {}

std::vector<wire::ErrorMessage> Relighter::set_state(const wire::RoomState& state,
                                                     const NamedEnvironments& environments,
                                                     const NamedFinishes& finishes,
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
    RoomLayer::Change of_layer;
    if (layer_ && stages.has(wire::Stage::signal)) {
        of_layer = layer_->set_state(state, finishes, *signal_, signal_is_new, problems);
        if (of_layer.pixels) {
            pixels_changed();
        }
    }
    const bool sees_environment = state.background.mode == wire::BackgroundMode::environment;
    const bool looks_anew =
        stages.has(wire::Stage::view) && (composer_->look(look_of(state)) || !state_);
    if (looks_anew || of_layer.parts) {
        looked_anew();
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
void Relighter::looked_anew() {
    if (layer_) {
        layer_->set_view(composer_->view());
    }
    const std::vector<float> weights = composer_->block_weights();
    if (weights.empty()) {
        return;
    }
    session_.set_block_weights(weights);
    if (!session_.exact()) {
        composer_->sums_have_changed();
    }
}

void Relighter::advance_layer(double milliseconds) {
    const Clock::time_point begin = Clock::now();
    if (layer_->advance(milliseconds)) {
        pixels_changed();
    }
    relight_time_ += Clock::now() - begin;
}

bool Relighter::exact() const {
    return (session_.exact() || !shows_transport()) && (!layer_ || layer_->is_exact());
}

bool Relighter::transport_rests() const {
    return session_.at_rest(state_->budget) || !shows_transport();
}

bool Relighter::at_rest() const {
    const double enough = state_->budget.target_error;
    return transport_rests() &&
           (!layer_ || !layer_->has_work() || (!layer_waits() && stated_error() <= enough));
}

double Relighter::stated_error() const {
    const double of_transport = session_.stated_error();
    return layer_ ? layer_->stated_error(of_transport, session_.shown_norm()) : of_transport;
}

void Relighter::pixels_changed() {
    ++pixels_;
    image_changed_ = true;
}

void Relighter::advance_together(std::span<Relighter* const> relighters) {
    const Clock::time_point begin = Clock::now();
    std::vector<engine::SessionStep> slices;
    std::vector<Relighter*> relit;
    for (Relighter* relighter : relighters) {
        // An image that waits for its layer alone has had what its budget allows.
        if (relighter->transport_rests() ||
            (relighter->layer_waits() &&
             relighter->budget_.is_spent(relighter->state_->budget))) {
            continue;
        }
        relit.push_back(relighter);
        slices.push_back({.session = &relighter->session_,
                          .budget = relighter->budget_.for_slice(relighter->state_->budget,
                                                                 relighters.size()),
                          .ceiling_milliseconds = relighter->budget_.ceiling_ms(),
                          .report = {}});
    }
    if (!slices.empty()) {
        engine::Session::advance_together(slices);
    }
    const Clock::duration spent = Clock::now() - begin;
    for (std::size_t i = 0; i < slices.size(); ++i) {
        relit[i]->relit(slices[i].report, spent);
    }
    for (Relighter* relighter : relighters) {
        if (relighter->layer_) {
            const bool shares = std::find(relit.begin(), relit.end(), relighter) != relit.end();
            relighter->advance_layer(relighter->budget_.ceiling_ms() / (shares ? 2 : 1));
        }
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
    return at_rest() || (!shows_state_before() && !layer_waits() &&
                         (transport_rests() || budget_.is_spent(state_->budget)));
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

// At edges show a few more vertices. What was exact stays so.
void Relighter::look_closer() {
    const bool was_exact = exact();
    if (!composer_->look_closer()) {
        return;
    }
    looked_anew();
    composer_->set_background(state_->background, signal_->rig());
    while (was_exact && layer_ && !layer_->is_exact()) {
        advance_layer(budget_.ceiling_ms());
    }
}

Picture Relighter::picture(const ImageStamp& stamp, const ImageForms& forms, int jpeg_quality) {
    if (stamp.settled) {
        look_closer();
    }
    compose(forms, stamp.settled);
    const bool is_exact = exact();
    const std::size_t to_come = layer_ ? layer_->remaining() : 0;
    Picture picture{
        .header = {.encoding = {},
                   .width = composer_->width(),
                   .height = composer_->height(),
                   .revision = stamp.revision,
                   .sequence = stamp.sequence,
                   .relative_error = is_exact ? 0.0F : static_cast<float>(stated_error()),
                   .exact = is_exact,
                   .has_alpha = false,
                   .edit_to_image_ms =
                       static_cast<float>(milliseconds(Clock::now() - stamp.edit_read_at)),
                   .relight_ms = static_cast<float>(milliseconds(relight_time_)),
                   .encode_ms = 0,
                   .coefficients_applied = applied_,
                   .payload_bytes = 0,
                   .coefficients_remaining = session_.exact() || !shows_transport()
                                                 ? static_cast<std::uint32_t>(to_come)
                                                 : remaining_},
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
