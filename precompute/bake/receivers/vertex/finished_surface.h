// From a mesh that has been split to the surface that is baked: clusters, texture coordinates,
// where triangles lie on the scene, who is whose neighbour.
#pragma once

#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/bake/receivers/vertex/row_axis.h"
#include "precompute/bake/receivers/vertex/split_mesh.h"
#include "precompute/scene/scene.h"

namespace relume::bake {

// `rows` are those of the mesh's vertices, [vertices]. Of the report, what the mesh knows.
// Texture coordinates are of the set by which the base colour is looked up, the first where it
// has no texture.
[[nodiscard]] RefinedSurface finished_surface(const scene::Scene& scene,
                                              const SplitMesh& mesh,
                                              Rows rows);

}  // namespace relume::bake
