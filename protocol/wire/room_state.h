// The state of a room: what its image shows. It changes only by patches (room_patch.h).
//
// Numbers are kept as doubles, so that what a client sets is what every client reads back.
// Plain values without locks: a state belongs to one thread at a time.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace relume::wire {

enum class BackgroundMode : std::uint8_t { environment, colour, transparent };
enum class Tone : std::uint8_t { filmic, linear };

[[nodiscard]] std::string_view name_from(BackgroundMode mode);
[[nodiscard]] std::string_view name_from(Tone tone);

struct Environment {
    std::string name = "sky";
    double gain = 1;
    Imath::V3d tint{1, 1, 1};

    friend bool operator==(const Environment&, const Environment&) = default;
};

// Radiance (1 − amount)·environment + amount·(environment `name`, under the same gain and
// tint).
struct Blend {
    std::optional<std::string> name;
    double amount = 0;

    friend bool operator==(const Blend&, const Blend&) = default;
};

// A round light at infinity; its radiance is radiance · gain · tint over the whole disc where
// it lights (see `lights_now`), else zero.
struct AreaLight {
    Imath::V3d direction{0, 1, 0};  // unit, towards the light, in the world
    double angular_radius_degrees = 1;
    Imath::V3d radiance{0, 0, 0};
    double gain = 1;
    Imath::V3d tint{1, 1, 1};
    std::optional<std::string> name =
        std::nullopt;  // what people call it; a label as names.h allows
    bool muted = false;
    bool solo = false;
    double order = 0;  // lists show lights in ascending order, equals by id

    friend bool operator==(const AreaLight&, const AreaLight&) = default;
};

struct Background {
    BackgroundMode mode = BackgroundMode::environment;
    Imath::V3d colour{0.05, 0.05, 0.05};

    friend bool operator==(const Background&, const Background&) = default;
};

struct Display {
    double exposure_stops = 0;
    Tone tone = Tone::filmic;

    friend bool operator==(const Display&, const Display&) = default;
};

struct RoomState {
    Environment environment;
    Blend blend;
    Imath::Quatd rotation;  // unit; world direction = rotation · source direction
    std::map<std::string, AreaLight> lights;
    Background background;
    relighting::Strategy strategy;
    relighting::Budget budget;
    Display display;

    friend bool operator==(const RoomState&, const RoomState&) = default;
};

// While any light is solo, muted or not, only solo lights light; environment and blend are
// dark.
[[nodiscard]] bool any_solo(const RoomState& state);
// A light that is muted never lights.
[[nodiscard]] bool lights_now(const AreaLight& light, bool any_solo);

// R = R_y(yaw) · R_x(pitch) · R_z(roll), as a unit quaternion.
[[nodiscard]] Imath::Quatd quaternion_from_yaw_pitch_roll_degrees(double yaw_degrees,
                                                                  double pitch_degrees,
                                                                  double roll_degrees);

// The object of protocol/README.md §3.1. What is not set (names of blend and lights, one of the
// budgets) is left out, so that the object is what merging all patches so far gives.
[[nodiscard]] nlohmann::json to_json(const RoomState& state);
[[nodiscard]] nlohmann::json to_json(const AreaLight& light);
// Throws WireError as apply_patch does.
[[nodiscard]] RoomState room_state_from_json(const nlohmann::json& object);

}  // namespace relume::wire
