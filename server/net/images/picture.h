// An image that is composed and waits to be encoded.
#pragma once

#include "protocol/wire/image_header.h"
#include "server/net/images/image_forms.h"

#include <memory>

namespace relume::net {

class FrameComposer;

struct Picture {
    // Without what encoding adds: the encoding, its time and the length of the payload.
    wire::ImageHeader header;
    bool has_alpha = false;  // of half planes
    bool settled = false;
    ImageForms forms;
    int jpeg_quality = 0;
    // Holds the pixels. It must compose nothing else before the picture is encoded.
    std::shared_ptr<const FrameComposer> composer;
};

}  // namespace relume::net
