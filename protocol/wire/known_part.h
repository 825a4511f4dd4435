// What a client of this version knows of a newer server's state.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace relume::wire {

// `state`, or a patch of it, without the sections and fields that this version does not have.
// What is no object stays as it is; whoever reads it refuses it.
[[nodiscard]] nlohmann::json known_part(const nlohmann::json& state);

}  // namespace relume::wire
