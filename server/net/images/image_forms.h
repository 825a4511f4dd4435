// The forms in which an image is to be encoded.
#pragma once

#include "protocol/wire/messages.h"

#include <cstddef>
#include <vector>

namespace relume::net {

struct ImageForms {
    // Of so many displays an image is made; viewers of a further one get the room's.
    static constexpr std::size_t kMostDisplays = 4;

    std::vector<wire::DisplayChoice> displays;  // one JPEG each
    bool half_planes = false;

    // Adds the display if it is new. Of more than there may be, the last makes place for the
    // room's.
    void add(const wire::DisplayChoice& display);
};

}  // namespace relume::net
