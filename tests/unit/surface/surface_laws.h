// What holds for every refined surface, whatever scene it comes from.
#pragma once

#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/scene/scene.h"

namespace relume::bake {

// Fails the running test where one of these does not hold:
// - mesh.bin takes the mesh; clusters hold all vertices, each of one material, ≤ 256;
// - every triangle lies on the side of the scene's triangle that it names: corners at their
//   barycentrics, texture coordinates interpolated, facing as it does;
// - of each of the scene's triangles that is seen, all of it is there, and once;
// - normals are unit and lie on the side of their triangles.
void expect_lawful(const scene::Scene& scene, const RefinedSurface& surface);

// No vertex lies within an edge that is not its own. By comparing each with each.
void expect_no_t_junction(const RefinedSurface& surface);

// Every edge, by position, has as many triangles one way as the other: of closed scenes.
void expect_closed(const RefinedSurface& surface);

}  // namespace relume::bake
