// One who is in a room: who they are for its history, and what they may do.
#pragma once

#include "server/net/peers/role.h"

#include <cstdint>

namespace relume::net {

// Differs between all viewers that a server has ever let into its rooms.
enum class ViewerId : std::uint64_t {};

struct Viewer {
    ViewerId id{};
    Role role = Role::none;
};

}  // namespace relume::net
