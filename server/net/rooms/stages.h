// What a room asks of the stages that an edit touches.
#pragma once

#include "protocol/wire/stages.h"

namespace relume::net {

// For whom nothing has been made yet.
inline constexpr wire::Stages kAllStages =
    wire::Stage::signal | wire::Stage::view | wire::Stage::display | wire::Stage::policy;

// Linear pixels may differ: no image that was made before shows the state.
[[nodiscard]] constexpr bool changes_pixels(wire::Stages stages) {
    return stages.has(wire::Stage::signal) || stages.has(wire::Stage::view);
}

}  // namespace relume::net
