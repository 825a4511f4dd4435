// The materials that a room's state gives to parts of its scene.
#pragma once

#include "protocol/wire/room_state.h"
#include "protocol/wire/scene_summary.h"
#include "server/net/library/material_library.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <memory>
#include <string>

namespace relume::net {

// By the part's ID.
using NamedFinishes = std::map<std::string, std::shared_ptr<const MaterialFamily>>;

// The patch with what follows where it names another material for a part: number and colours
// are those of the new material, unless the patch states them.
[[nodiscard]] nlohmann::json with_fresh_finishes(const nlohmann::json& patch,
                                                 const wire::Finishes& before);

// The materials of the finishes of `state`, which `patch` (normalised) has made of the state
// before. A finish that the patch does not touch keeps its material. Throws wire::WireError:
// unknown_name for a part that the scene does not have and for a material that is not offered
// for it, out_of_range for colours that are not as many as lobes and for a number beyond the
// family's, unsupported for a number of what is no family.
[[nodiscard]] NamedFinishes finishes_after(const NamedFinishes& before,
                                           const wire::RoomState& state,
                                           const nlohmann::json& patch,
                                           const wire::SceneSummary& scene,
                                           const MaterialLibrary& library);

}  // namespace relume::net
