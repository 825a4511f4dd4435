// Encoded images as they go over the wire, shared by all who see the room.
#pragma once

#include "protocol/wire/image_header.h"
#include "protocol/wire/messages.h"
#include "server/net/images/image_interest.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relume::net {

struct ImageFrame {
    wire::ImageHeader header;
    std::vector<std::byte> bytes;  // header and payload
    bool settled = false;          // of a state that rests
};
using SharedImageFrame = std::shared_ptr<const ImageFrame>;

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

    // For a viewer of this interest and display: a JPEG of another display, the room's where
    // there is one, if there is none of his own; null where he gets nothing.
    [[nodiscard]] SharedImageFrame for_viewer(ImageInterest interest,
                                              const wire::DisplayChoice& display) const;
};

}  // namespace relume::net
