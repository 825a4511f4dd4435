// The vertices of given radiance that an image shows.
#pragma once

#include "server/view/mesh/drawn_surface.h"
#include "server/view/mesh/given_radiance.h"
#include "server/view/mesh/visible_surface.h"
#include "server/view/view.h"

#include <cstdint>
#include <vector>

namespace relume::view {

// Those of the materials that are given radiance. Spread over the caller's arena.
[[nodiscard]] SeenVertices seen_vertices(const DrawnSurface& surface,
                                         const VisibleSurface& visible,
                                         const GivenRadiance& given);

}  // namespace relume::view
