// Where the views of a scene begin.
#pragma once

#include "protocol/transport/manifest.h"
#include "protocol/transport/surface_mesh.h"
#include "server/scene/scene_bounds.h"
#include "server/view/view.h"

namespace relume::served {

// Of the one camera that an image transport has. It looks at a point at distance 1.
[[nodiscard]] view::Look beginning_of_image(const transport::Manifest& manifest);
// Of a mesh transport. It looks at what its manifest's camera sees in the middle, or, where
// that sees nothing there, as far as the middle of the scene.
[[nodiscard]] view::Look beginning_of_mesh(const transport::Manifest& manifest,
                                           const transport::SurfaceMesh& mesh,
                                           const SceneBounds& bounds);

}  // namespace relume::served
