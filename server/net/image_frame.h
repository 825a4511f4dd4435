// One encoded image as it goes over the wire, shared by all who see the room.
#pragma once

#include "protocol/wire/image_header.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace relume::net {

struct ImageFrame {
    wire::ImageHeader header;
    std::vector<std::byte> bytes;  // header and payload

    // The bit-exact image that follows when the state rests.
    [[nodiscard]] bool settled() const {
        return header.encoding == wire::ImageEncoding::half_planes;
    }
};
using SharedImageFrame = std::shared_ptr<const ImageFrame>;

}  // namespace relume::net
