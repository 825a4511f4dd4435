#include "protocol/wire/room_state.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/room_names.h"
#include "protocol/wire/room_patch.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relume::wire {
namespace {

using nlohmann::json;

json array_from_vector(const Imath::V3d& v) {
    return json::array({v.x, v.y, v.z});
}

Imath::Quatd quaternion_about(const Imath::V3d& axis, double degrees) {
    const double half_angle = degrees * std::numbers::pi / 360.0;
    return {std::cos(half_angle), std::sin(half_angle) * axis};
}

}  // namespace

std::string_view name_from(BackgroundMode mode) {
    return kBackgroundModeNames.name(mode);
}
std::string_view name_from(Tone tone) {
    return kToneNames.name(tone);
}

Imath::Quatd quaternion_from_yaw_pitch_roll_degrees(double yaw_degrees,
                                                    double pitch_degrees,
                                                    double roll_degrees) {
    return (quaternion_about({0, 1, 0}, yaw_degrees) *
            quaternion_about({1, 0, 0}, pitch_degrees) *
            quaternion_about({0, 0, 1}, roll_degrees))
        .normalized();
}

bool any_solo(const RoomState& state) {
    return std::any_of(state.lights.begin(), state.lights.end(),
                       [](const auto& entry) { return entry.second.solo; });
}

bool lights_now(const AreaLight& light, bool any_solo) {
    return !light.muted && (light.solo || !any_solo);
}

json to_json(const AreaLight& light) {
    json object = {{"direction", array_from_vector(light.direction)},
                   {"angular_radius_degrees", light.angular_radius_degrees},
                   {"radiance", array_from_vector(light.radiance)},
                   {"gain", light.gain},
                   {"tint", array_from_vector(light.tint)},
                   {"muted", light.muted},
                   {"solo", light.solo},
                   {"order", light.order}};
    if (light.name) {
        object["name"] = *light.name;
    }
    return object;
}

json to_json(const RoomState& state) {
    json blend = {{"amount", state.blend.amount}};
    if (state.blend.name) {
        blend["name"] = *state.blend.name;
    }
    json budget = {{"target_error", state.budget.target_error}};
    if (state.budget.milliseconds) {
        budget["milliseconds"] = *state.budget.milliseconds;
    }
    if (state.budget.coefficients) {
        budget["coefficients"] = *state.budget.coefficients;
    }
    json lights = json::object();
    for (const auto& [id, light] : state.lights) {
        lights[id] = to_json(light);
    }
    const Imath::Quatd& q = state.rotation;
    return {{"environment",
             {{"name", state.environment.name},
              {"gain", state.environment.gain},
              {"tint", array_from_vector(state.environment.tint)}}},
            {"blend", std::move(blend)},
            {"rotation", {{"quaternion", {q.r, q.v.x, q.v.y, q.v.z}}}},
            {"lights", std::move(lights)},
            {"background",
             {{"mode", name_from(state.background.mode)},
              {"colour", array_from_vector(state.background.colour)}}},
            {"strategy",
             {{"method", name_from(state.strategy.method)},
              {"priority", name_from(state.strategy.priority)}}},
            {"budget", std::move(budget)},
            {"display",
             {{"exposure_stops", state.display.exposure_stops},
              {"tone", name_from(state.display.tone)}}}};
}

RoomState room_state_from_json(const json& object) {
    ObjectReader reader(object, "");
    for (const char* section : {"environment", "blend", "rotation", "lights", "background",
                                "strategy", "budget", "display"}) {
        static_cast<void>(reader.require(section));
    }
    RoomState state;
    Limits limits;
    limits.lights_per_room = kMaxInteger;  // the server that sent it enforces its own
    apply_patch(state, object, limits);
    return state;
}

}  // namespace relume::wire
