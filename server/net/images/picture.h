// An image that is composed and waits to be encoded.
#pragma once

#include "protocol/wire/image_header.h"
#include "server/net/images/image_forms.h"

#include <memory>

namespace relume::net {

class FrameComposer;

struct Picture {
    // All but the encoding and what it tells: its time and the payload's length.
    wire::ImageHeader header;
    bool has_alpha = false;  // of half planes
    bool settled = false;
    ImageForms forms;
    int jpeg_quality = 0;
    // Holds the pixels, as the encoding takes them; composes nothing else before the picture is
    // encoded.
    std::shared_ptr<const FrameComposer> composer;
};

}  // namespace relume::net
