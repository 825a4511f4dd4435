// What a client may do on this server.
#pragma once

#include <cstdint>

namespace relume::net {

enum class Role : std::uint8_t {
    none,    // may not watch a room, edit one or upload
    editor,  // may do all of that
};

}  // namespace relume::net
