// One slice of a room's work: what it is given, and what it gives back.
#pragma once

#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/net/images/image_frame.h"
#include "server/net/images/picture.h"
#include "server/net/rooms/named_environments.h"
#include "server/net/rooms/named_finishes.h"
#include "server/net/rooms/schedule.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace relume::net {

// Copied from the room under its lock.
struct RoomSlice {
    SliceOrder order;
    wire::RoomState state;  // set if the order takes it
    NamedEnvironments environments;
    NamedFinishes finishes;
    std::uint64_t revision = 0;  // of the state that is relit
    bool settled_image_due = false;
    // An earlier settled image. If nothing has been relit since, it shows this state as well.
    SharedImageFrame earlier_settled;
    // Taken when the slice begins, and anew when a picture may be due:
    bool encoder_is_free = false;
    bool viewer_is_ready = false;  // for an image of an unsettled state
    ImageForms moving_forms;       // in which such an image is asked for
};

struct SliceResult {
    std::vector<wire::ErrorMessage> problems;
    SliceOutcome outcome;
    std::optional<Picture> picture;  // to be encoded
    SharedImageFrame restamped;      // `earlier_settled` under this revision, to be sent again
};

}  // namespace relume::net
