// The forms in which an image is to be encoded.
#pragma once

#include "protocol/wire/messages.h"

#include <cstddef>
#include <vector>

namespace relume::net {

struct ImageForms {
    // An image is made for so many displays. Viewers of a further display get the room's.
    static constexpr std::size_t kMostDisplays = 4;

    std::vector<wire::DisplayChoice> displays;  // one JPEG each
    bool half_planes = false;

    // Adds the display if it is new. Where there are too many, the room's display takes the
    // place of the last.
    void add(const wire::DisplayChoice& display);
};

}  // namespace relume::net
