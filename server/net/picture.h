// An image that is composed and waits to be encoded.
#pragma once

#include "protocol/wire/image_header.h"
#include "server/net/display_table.h"

#include <memory>

namespace relume::net {

class FrameComposer;

struct Picture {
    // All but what encoding tells: its time and the payload's length.
    wire::ImageHeader header;
    int jpeg_quality = 0;  // of a JPEG
    // Holds the pixels; composes nothing else before the picture is encoded.
    std::shared_ptr<FrameComposer> composer;
    std::shared_ptr<const DisplayTable> display;
};

}  // namespace relume::net
