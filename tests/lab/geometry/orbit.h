// A camera that goes around what it looks at.
#pragma once

#include "server/view/view.h"

namespace relume::lab {

// By so many degrees about the vertical through what it looks at, from +Z towards +X; at the
// same height and distance.
[[nodiscard]] view::Look orbited(const view::Look& from, double degrees);

}  // namespace relume::lab
