// The environments that a room's state names.
#pragma once

#include "protocol/wire/room_state.h"
#include "server/net/library/environment_library.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>

namespace relume::net {

// `blend` is null when the state names none.
struct NamedEnvironments {
    std::shared_ptr<Environment> environment;
    std::shared_ptr<Environment> blend;

    friend bool operator==(const NamedEnvironments&, const NamedEnvironments&) = default;
};

// The environments of `state`, which `patch` (normalised) has made of the state before. A map
// that the patch does not name stays as it was, and one that it names again is taken in its
// latest version. Throws wire::WireError (unknown_name).
[[nodiscard]] NamedEnvironments environments_after(const NamedEnvironments& before,
                                                   const wire::RoomState& state,
                                                   const nlohmann::json& patch,
                                                   const EnvironmentLibrary& library);

}  // namespace relume::net
