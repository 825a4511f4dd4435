#include "server/net/rooms/relighter.h"

#include <Imath/ImathMath.h>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

namespace relume::net {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

light::AreaLight area_light_from(const wire::AreaLight& light) {
    return {.direction = Imath::V3f(light.direction),
            .angular_radius_radians =
                static_cast<float>(light.angular_radius_degrees * kRadiansPerDegree),
            .radiance = Imath::V3f(light.radiance * light.tint * light.gain)};
}

// Black, and a problem to report, if it cannot be decoded.
std::shared_ptr<const light::PrefilteredEnvironment> prefiltered(
    const std::shared_ptr<Environment>& environment,
    std::uint32_t face_resolution,
    const char* path,
    std::vector<wire::ErrorMessage>& problems) {
    if (!environment) {
        return nullptr;
    }
    try {
        return environment->prefiltered(face_resolution);
    } catch (const light::EnvironmentError& failure) {
        problems.push_back({.code = wire::ErrorCode::bad_image,
                            .message = "the environment cannot be decoded and is shown black",
                            .path = path,
                            .found = failure.found().empty() ? environment->description().name
                                                             : failure.found(),
                            .expected = failure.expected().empty() ? "a readable HDR image"
                                                                   : failure.expected(),
                            .edit_id = {}});
        return nullptr;
    }
}

light::LightRig rig_from_state(const wire::RoomState& state,
                               const NamedEnvironments& environments,
                               std::uint32_t face_resolution,
                               std::vector<wire::ErrorMessage>& problems) {
    light::LightRig rig;
    rig.environment =
        prefiltered(environments.environment, face_resolution, "/environment/name", problems);
    rig.blend = prefiltered(environments.blend, face_resolution, "/blend/name", problems);
    rig.blend_amount = environments.blend ? static_cast<float>(state.blend.amount) : 0.0F;
    rig.rotation = Imath::Quatf(state.rotation.quaternion);
    rig.environment_scale = Imath::V3f(state.environment.tint * state.environment.gain);
    const bool solo = wire::any_solo(state.lights);
    if (solo) {
        rig.environment = nullptr;
        rig.blend = nullptr;
    }
    for (const auto& [id, light] : state.lights) {
        if (wire::lights_now(light, solo)) {
            rig.lights.push_back(area_light_from(light));
        }
    }
    return rig;
}

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
      budget_(milliseconds(ceiling)) {}

std::vector<wire::ErrorMessage> Relighter::set_state(const wire::RoomState& state,
                                                     const NamedEnvironments& environments,
                                                     wire::Stages stages) {
    const Clock::time_point begin = Clock::now();
    std::vector<wire::ErrorMessage> problems;
    if (!state_) {
        stages = kAllStages;
    }
    const bool light_is_new =
        stages.has(wire::Stage::signal) && set_light(state, environments, problems);
    const bool sees_environment = state.background.mode == wire::BackgroundMode::environment;
    if (stages.has(wire::Stage::view) && (composer_->look(look_of(state)) || !state_)) {
        tell_session_what_counts();
    }
    if (stages.has(wire::Stage::view) || (light_is_new && sees_environment)) {
        composer_->set_background(state.background, rig_);
        pixels_changed();
    }
    if (stages.has(wire::Stage::policy)) {
        session_.set_strategy(state.strategy);
    }
    if (stages.has(wire::Stage::display)) {
        image_changed_ = true;
    }
    state_ = state;
    if (light_is_new) {
        const Clock::duration spent = Clock::now() - begin;
        metrics_.observe_lighting(seconds(spent));
        budget_.begin_step(milliseconds(spent));
        relight_time_ += spent;
    }
    return problems;
}

bool Relighter::set_light(const wire::RoomState& state,
                          const NamedEnvironments& environments,
                          std::vector<wire::ErrorMessage>& problems) {
    const std::uint32_t n = scene_->loaded->face_resolution();
    light::LightRig rig = rig_from_state(state, environments, n, problems);
    if (state_ && rig == rig_) {
        return false;
    }
    rig_ = std::move(rig);
    light::evaluate(rig_, n, cubemap_);
    light::lighting_coefficients(cubemap_, scene_->loaded->projection(), coefficients_);
    session_.set_target(coefficients_);
    pixels_changed();
    return true;
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
        composer_->set_background(state_->background, rig_);
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
