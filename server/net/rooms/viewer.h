// Somebody in a room: an id, by which the room's history names them, and what they may do.
#pragma once

#include "server/net/peers/role.h"

#include <cstdint>

namespace relume::net {

// Unique among all viewers that a server ever lets into its rooms.
enum class ViewerId : std::uint64_t {};

struct Viewer {
    ViewerId id{};
    Role role = Role::none;
};

}  // namespace relume::net
