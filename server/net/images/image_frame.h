// Encoded images as they go over the wire, shared by all who see the room.
#pragma once

#include "protocol/wire/image_header.h"
#include "protocol/wire/messages.h"
#include "server/net/base/clock.h"
#include "server/net/images/image_interest.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace relume::net {

// Which edit an image answers, and how long that took.
struct ImageStamp {
    std::uint64_t revision = 0;
    std::uint64_t sequence = 0;
    Clock::time_point edit_read_at;
    bool settled = false;  // the state rests
};

struct ImageFrame {
    wire::ImageHeader header;
    std::vector<std::byte> bytes;  // header and payload
    bool settled = false;          // of a state that rests
};
using SharedImageFrame = std::shared_ptr<const ImageFrame>;

// The same picture under another revision, which it shows as well. Its header states no cost.
[[nodiscard]] SharedImageFrame restamped(const ImageFrame& frame, const ImageStamp& stamp);

// One image of a room in every form that its viewers asked for. All of them have one sequence
// number.
struct ImageFrames {
    struct Jpeg {
        wire::DisplayChoice display;
        SharedImageFrame frame;
    };
    std::vector<Jpeg> jpegs;       // of different displays
    SharedImageFrame half_planes;  // null if nobody asked for it
    bool settled = false;

    // The frame for a viewer of this interest and display. Where there is no JPEG of that
    // display it is a JPEG of another one, the room's if there is one. Null where the viewer
    // gets nothing.
    [[nodiscard]] SharedImageFrame for_viewer(ImageInterest interest,
                                              const wire::DisplayChoice& display) const;
};

}  // namespace relume::net
