#include "server/net/rooms/relighter.h"

#include "server/view/tile_addend.h"

#include <algorithm>
#include <cmath>
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

std::unique_ptr<view::View> make_view(const served::Scene& scene,
                                      const view::TileAddend* addend) {
    std::unique_ptr<view::View> view = scene.make_view();
    if (addend == nullptr) {
        return view;
    }
    return std::make_unique<view::AddedView>(std::move(view), *addend);
}

}  // namespace

Relighter::Relighter(std::shared_ptr<const ServedScene> scene,
                     Metrics& metrics,
                     Clock::duration ceiling,
                     std::size_t material_bytes)
    : scene_(std::move(scene)),
      metrics_(metrics),
      session_(scene_->loaded->workspace(), relighting::Strategy{}),
      materials_(scene_->loaded->editable_points()
                     ? std::unique_ptr<Materials>(new Materials{
                           EditedMaterials(scene_->loaded->editable_points()),
                           materials::MaterialLayer(scene_->loaded->editable_points(),
                                                    material_bytes)})
                     : nullptr),
      composer_(std::make_shared<FrameComposer>(
          make_view(*scene_->loaded, materials_ ? &materials_->layer : nullptr), scene_->sky)),
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
    if (materials_ && stages.has(wire::Stage::signal)) {
        set_materials(state, signal_is_new);
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

// A layer that shows nothing is not told of the light.
void Relighter::set_materials(const wire::RoomState& state, bool light_is_new) {
    materials_->light_is_new = materials_->light_is_new || light_is_new;
    const bool edits_are_new = materials_->edited.set_edits(state.materials);
    if (materials_->light_is_new && !state.materials.empty()) {
        materials_->layer.set_light(*signal_->cubemap());
        materials_->light_is_new = false;
    }
    if (edits_are_new) {
        materials_->layer.set_shown(materials_->edited.shown());
        pixels_changed();
    }
}

void Relighter::advance_materials(double milliseconds) {
    const Clock::time_point begin = Clock::now();
    if (materials_->layer.advance(milliseconds)) {
        pixels_changed();
    }
    relight_time_ += Clock::now() - begin;
}

bool Relighter::exact() const {
    return session_.exact() && (!materials_ || materials_->layer.is_whole());
}

bool Relighter::at_rest() const {
    const double enough = state_->budget.target_error;
    return session_.at_rest(state_->budget) &&
           (!materials_ || !materials_->layer.has_work() ||
            (!materials_->layer.awaits_first_look() && stated_error() <= enough));
}

// What the light's image lacks and what materials lack are independent. Of an edit that is not
// to be seen yet nothing is known.
double Relighter::stated_error() const {
    if (materials_ && materials_->layer.awaits_first_look()) {
        return 1;
    }
    const double of_light = session_.stated_error();
    const double of_materials = materials_ ? materials_->layer.error() : 0;
    if (of_materials == 0) {
        return of_light;
    }
    const double norm = session_.shown_norm();
    return norm > 0 ? std::hypot(of_light, of_materials / norm) : 1;
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
        if (relighter->session_.at_rest(relighter->state_->budget)) {
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
        if (relighter->materials_) {
            relighter->advance_materials(relighter->budget_.ceiling_ms() / 2);
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
    const bool is_seen = !materials_ || !materials_->layer.awaits_first_look();
    return at_rest() ||
           (!shows_state_before() && is_seen &&
            (session_.at_rest(state_->budget) || budget_.is_spent(state_->budget)));
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
    const bool is_exact = exact();
    const std::size_t tiles_to_come = materials_ ? materials_->layer.tiles_to_come() : 0;
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
                   .coefficients_remaining = session_.exact()
                                                 ? static_cast<std::uint32_t>(tiles_to_come)
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
