#include "server/net/rooms/relighter.h"

#include <Imath/ImathMath.h>
#include <tbb/task_arena.h>

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

// So much of an image's time goes to relighting, however slow the rest is: in less, hardly more
// than choosing gets done, and pictures come sooner but far off.
constexpr double kLeastShare = 0.2;

void blend(double& mean, double newest) {
    constexpr double kNewest = 0.2;
    mean += kNewest * (newest - mean);
}

bool same_rig(const wire::RoomState& a, const wire::RoomState& b) {
    return a.environment == b.environment && a.blend == b.blend && a.rotation == b.rotation &&
           a.lights == b.lights;
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

}  // namespace

Relighter::Relighter(std::shared_ptr<const ServedScene> scene,
                     Metrics& metrics,
                     Clock::duration ceiling)
    : scene_(std::move(scene)),
      metrics_(metrics),
      ceiling_ms_(milliseconds(ceiling)),
      session_(scene_->engine, relighting::Strategy{}),
      composer_(std::make_shared<FrameComposer>(
          scene_->sky, scene_->engine->image().width, scene_->engine->image().height)) {}

std::vector<wire::ErrorMessage> Relighter::set_state(const wire::RoomState& state,
                                                     const NamedEnvironments& environments) {
    const Clock::time_point begin = Clock::now();
    std::vector<wire::ErrorMessage> problems;
    const bool rig_changed =
        !state_ || environments_ != environments || !same_rig(*state_, state);
    if (rig_changed) {
        set_rig(state, environments, problems);
    }
    const bool sees_environment = state.background.mode == wire::BackgroundMode::environment;
    if (!state_ || state_->background != state.background ||
        (rig_changed && sees_environment)) {
        composer_->set_background(state.background, rig_);
    }
    session_.set_strategy(state.strategy);
    state_ = state;
    environments_ = environments;
    image_changed_ = true;
    const Clock::duration spent = Clock::now() - begin;
    metrics_.observe_lighting(seconds(spent));
    blend(lighting_ms_, milliseconds(spent));
    lighting_is_new_ = true;
    spent_ms_ = 0;
    spent_columns_ = 0;
    relight_time_ += spent;
    return problems;
}

void Relighter::set_rig(const wire::RoomState& state,
                        const NamedEnvironments& environments,
                        std::vector<wire::ErrorMessage>& problems) {
    const std::uint32_t n = scene_->engine->face_resolution();
    rig_.environment = prefiltered(environments.environment, n, "/environment/name", problems);
    rig_.blend = prefiltered(environments.blend, n, "/blend/name", problems);
    rig_.blend_amount = environments.blend ? static_cast<float>(state.blend.amount) : 0.0F;
    rig_.rotation = Imath::Quatf(state.rotation);
    rig_.environment_scale = Imath::V3f(state.environment.tint * state.environment.gain);
    rig_.lights.clear();
    const bool solo = wire::any_solo(state);
    if (solo) {
        rig_.environment = nullptr;
        rig_.blend = nullptr;
    }
    for (const auto& [id, light] : state.lights) {
        if (wire::lights_now(light, solo)) {
            rig_.lights.push_back(area_light_from(light));
        }
    }
    light::evaluate(rig_, n, cubemap_);
    light::lighting_coefficients(cubemap_, scene_->engine->projection(), coefficients_);
    session_.set_lighting(coefficients_);
}

void Relighter::advance_together(std::span<Relighter* const> relighters) {
    const Clock::time_point begin = Clock::now();
    std::vector<engine::SessionTurn> turns;
    for (Relighter* relighter : relighters) {
        turns.push_back({.session = &relighter->session_,
                         .budget = relighter->budget_for_slice(relighters.size()),
                         .ceiling_milliseconds = relighter->ceiling_ms_,
                         .report = {}});
    }
    engine::Session::advance_together(turns);
    const Clock::duration spent = Clock::now() - begin;
    for (std::size_t i = 0; i < turns.size(); ++i) {
        relighters[i]->stepped(turns[i].report, spent);
    }
}

void Relighter::stepped(const engine::StepReport& step, Clock::duration spent) {
    lighting_is_new_ = false;
    metrics_.count_step(step, seconds(spent));
    relight_time_ += spent;
    spent_ms_ += milliseconds(spent);
    spent_columns_ += step.applied;
    applied_ += step.applied;
    remaining_ = step.remaining;
    image_changed_ = image_changed_ || step.image_changed;
}

relighting::Budget Relighter::budget_for_relighting(std::size_t sessions) const {
    relighting::Budget budget = state_->budget;
    if (budget.milliseconds) {
        // All of them are lit, composed and encoded on the same threads.
        const double rounds = std::max(
            1.0, static_cast<double>(sessions) / tbb::this_task_arena::max_concurrency());
        const double taken =
            rounds * (compose_ms_ + beside_ms_ + (lighting_is_new_ ? lighting_ms_ : 0));
        budget.milliseconds =
            std::max(kLeastShare * *budget.milliseconds, *budget.milliseconds - taken);
    }
    return budget;
}

bool Relighter::budget_is_spent() const {
    // So much of a slice.
    constexpr double kNotWorthASlice = 0.25;
    // The largest budget in milliseconds that a state can have.
    constexpr double kLongestImageMs = 1000;
    if (at_rest()) {
        return true;
    }
    if (shows_state_before()) {
        return false;
    }
    if (state_->budget.coefficients) {
        return spent_columns_ >= *state_->budget.coefficients || spent_ms_ >= kLongestImageMs;
    }
    const double whole = budget_for_relighting(1).milliseconds.value_or(0);
    return spent_ms_ > 0 &&
           (whole <= ceiling_ms_ || whole - spent_ms_ < kNotWorthASlice * ceiling_ms_);
}

relighting::Budget Relighter::budget_for_slice(std::size_t sessions) const {
    relighting::Budget budget = budget_for_relighting(sessions);
    if (budget.coefficients && spent_columns_ < *budget.coefficients) {
        *budget.coefficients -= spent_columns_;
    }
    if (budget.milliseconds && spent_ms_ < *budget.milliseconds) {
        *budget.milliseconds -= spent_ms_;
    }
    return budget;
}

void Relighter::compose(const ImageForms& forms, bool settled) {
    const Clock::time_point begin = Clock::now();
    composer_->compose(session_, displays_.of(forms.displays, state_->display),
                       forms.half_planes);
    const Clock::duration spent = Clock::now() - begin;
    metrics_.observe_compose(seconds(spent));
    if (!settled) {
        blend(compose_ms_, milliseconds(spent));
    }
}

Picture Relighter::picture(const ImageStamp& stamp, const ImageForms& forms, int jpeg_quality) {
    compose(forms, stamp.settled);
    const transport::TileGrid& image = scene_->engine->image();
    const bool exact = session_.exact();
    Picture picture{
        .header = {.encoding = {},
                   .width = image.width,
                   .height = image.height,
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
