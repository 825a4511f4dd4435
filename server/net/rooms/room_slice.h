// One slice of a room's work: what it needs to know, and what came of it.
#pragma once

#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/net/base/clock.h"
#include "server/net/images/picture.h"
#include "server/net/rooms/relighter.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace relume::net {

// Copied from the room under its lock.
struct RoomSlice {
    bool state_changed = false;
    wire::RoomState state;  // set if it changed
    NamedEnvironments environments;
    std::uint64_t revision = 0;  // of the state that is relit
    Clock::time_point begun_at;
    Clock::time_point edit_read_at;
    Clock::time_point settle_at;
    bool first_image_due = false;  // of an edit, once its budget is spent
    // An edit has been relit when the encoder was busy or no viewer ready, and now both are.
    bool only_picture_is_missing = false;
    bool settled_image_due = false;
    // As it is when the picture is due, not when the slice begins:
    bool encoder_is_free = false;
    bool viewer_wants_moving = false;
    ImageForms moving_forms;  // that viewers want
    // What an image has been taking besides the slice: to wait for a worker, and to be encoded.
    double beside_ms = 0;
};

struct SliceResult {
    std::vector<wire::ErrorMessage> problems;
    std::optional<Picture> picture;
    bool at_rest = false;
    // All of the budget has gone into the image of the state.
    bool image_is_complete = true;
};

}  // namespace relume::net
