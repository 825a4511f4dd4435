// What a room has to know of the stages that an edit touches.
#pragma once

#include "protocol/wire/stages.h"

namespace relume::net {

// The stages of a state of which nothing has been made yet.
inline constexpr wire::Stages kAllStages =
    wire::Stage::signal | wire::Stage::view | wire::Stage::display | wire::Stage::policy;

// Whether linear pixels may differ, so that no image that was made before shows the state.
[[nodiscard]] constexpr bool changes_pixels(wire::Stages stages) {
    return stages.has(wire::Stage::signal) || stages.has(wire::Stage::view);
}

}  // namespace relume::net
