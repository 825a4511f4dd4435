// The exposure at which an image is looked at.
#pragma once

#include "protocol/wire/room_state.h"

#include <span>

namespace relume::lab {

// Gives interleaved RGB radiance a mean luminance of 0.18 before the tone curve; no change
// where it is black.
[[nodiscard]] wire::Display display_for(std::span<const float> rgb);

}  // namespace relume::lab
