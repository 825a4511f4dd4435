// Random patches of a room's state, made from the descriptions of its sections; within
// RapidCheck properties only.
#pragma once

#include "protocol/wire/room_state.h"

#include <nlohmann/json.hpp>

namespace relume::wire {

[[nodiscard]] bool chance();

// A patch that `state` takes.
[[nodiscard]] nlohmann::json valid_patch(const RoomState& state);

// A state some edits away from the default one.
[[nodiscard]] RoomState any_state();

// Replaces one random value inside `value` by one of a foreign kind.
void spoil(nlohmann::json& value);

}  // namespace relume::wire
