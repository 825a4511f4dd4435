// How much each block of a mesh transport counts in an image.
#pragma once

#include "server/view/mesh/drawn_surface.h"
#include "server/view/mesh/given_radiance.h"
#include "server/view/mesh/visible_surface.h"

#include <vector>

namespace relume::view {

// [blocks], as View::block_weights: the mean over a cluster's vertices of how many places of
// the image have a corner there, for each of its terms; 0 of materials that are `given`
// radiance, if any is. Terms are scaled so that they count alike (brdf/factored_brdf.h). 1 for
// all where nothing is seen. Spread over the caller's arena; does not depend on the threads.
[[nodiscard]] std::vector<float> block_weights(const DrawnSurface& surface,
                                               const VisibleSurface& visible,
                                               const GivenRadiance* given = nullptr);

}  // namespace relume::view
