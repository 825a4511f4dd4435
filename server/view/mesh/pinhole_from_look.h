// Where a look is taken from, as a pinhole.
#pragma once

#include "protocol/transport/mesh_section.h"
#include "server/view/mesh/pixel_space.h"
#include "server/view/view.h"

namespace relume::view {

// In the frame of the scene.
[[nodiscard]] Pinhole pinhole_from_look(const Look& look, const transport::FrameRecord& frame);

}  // namespace relume::view
