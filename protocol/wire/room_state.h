// The state of a room: what its image shows. It changes only by patches (room_patch.h).
//
// Numbers are kept as doubles, so that what a client sets is what every client reads back.
// Plain values without locks: a state belongs to one thread at a time.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/relighting/strategy.h"
#include "protocol/wire/sections/area_lights.h"
#include "protocol/wire/sections/background.h"
#include "protocol/wire/sections/blend.h"
#include "protocol/wire/sections/camera.h"
#include "protocol/wire/sections/display.h"
#include "protocol/wire/sections/environment.h"
#include "protocol/wire/sections/finishes.h"
#include "protocol/wire/sections/image_size.h"
#include "protocol/wire/sections/materials.h"
#include "protocol/wire/sections/rotation.h"

#include <nlohmann/json_fwd.hpp>

namespace relume::wire {

// A member a section; each is described in sections/.
struct RoomState {
    Environment environment;
    Blend blend;
    Rotation rotation;
    AreaLights lights;
    MaterialEdits materials;
    Finishes finishes;
    Background background;
    Camera camera;
    ImageSize image;
    relighting::Strategy strategy;
    relighting::Budget budget;
    Display display;

    friend bool operator==(const RoomState&, const RoomState&) = default;
};

// The object of protocol/README.md §3.1. What is not set (names of blend and lights, one of the
// budgets) is left out, so that the object is what merging all patches so far gives.
[[nodiscard]] nlohmann::json to_json(const RoomState& state);
// Sections and fields that the object lacks have their defaults, so that what an older version
// stored stays readable. Throws WireError as apply_patch does.
[[nodiscard]] RoomState room_state_from_json(const nlohmann::json& object);

}  // namespace relume::wire
