// What a client may do on this server.
#pragma once

#include <cstdint>

namespace relume::net {

enum class Role : std::uint8_t {
    none,    // may not enter a room or upload
    editor,  // may watch, edit and upload
};

}  // namespace relume::net
