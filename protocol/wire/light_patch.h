// The part of an edit's patch that concerns a room's area lights.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/room_state.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>

namespace relume::wire {

// Applies `patch`, an object of lights by id, and returns it normalised: a new light with all
// its fields, its `name` null where it has none. Throws WireError with paths below `path`;
// `lights` may then be half changed.
[[nodiscard]] nlohmann::json patch_lights(std::map<std::string, AreaLight>& lights,
                                          const nlohmann::json& patch,
                                          const std::string& path,
                                          const Limits& limits);

}  // namespace relume::wire
