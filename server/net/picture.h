// An image that is composed and waits to be encoded.
#pragma once

#include "protocol/wire/image_header.h"

#include <memory>

namespace relume::net {

class FrameComposer;

struct Picture {
    // All but what encoding tells: its time and the payload's length.
    wire::ImageHeader header;
    int jpeg_quality = 0;  // of a JPEG
    // Holds the pixels, as the encoding takes them; composes nothing else before the picture is
    // encoded.
    std::shared_ptr<const FrameComposer> composer;
};

}  // namespace relume::net
