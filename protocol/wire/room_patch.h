// Edits of a room's state: JSON Merge Patches [RFC 7396], validated.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/room_state.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>

namespace relume::wire {

struct AppliedPatch {
    // What was asked for, *normalised*: the rotation a unit quaternion, directions of unit
    // length, a new light with all its fields, no null for a light that is not there, one
    // budget clearing the other. Normalised patches may be merged with each other and into the
    // state's JSON by RFC 7396 alone, and applying one again changes nothing.
    nlohmann::json patch;
    // Normalised, too: applied to the state that `patch` has led to, it gives the state from
    // before bit for bit, and names nothing that `patch` does not name. Of patches in turn, the
    // inverses merged from the last to the first undo them all.
    nlohmann::json inverse;
};

// Checks the whole patch, then applies it.
//
// Throws WireError with a path into the patch, and leaves `state` as it was. Names of
// environments are checked for form only; whether they exist is for the caller to know.
AppliedPatch apply_patch(RoomState& state, const nlohmann::json& patch, const Limits& limits);

// Throws WireError{unsupported} naming the first section in which the states differ and that is
// not among `edits`, the sections that a scene lets people edit (scene_summary.h).
void require_kept(const RoomState& before,
                  const RoomState& after,
                  std::span<const std::string> edits);

// The patch that has the effect of `first` and then `second`. Both are normalised (or touch
// disjoint parts): composing merge patches is exact only where a removed object comes back
// whole.
[[nodiscard]] nlohmann::json merge_patches(nlohmann::json first, const nlohmann::json& second);

}  // namespace relume::wire
