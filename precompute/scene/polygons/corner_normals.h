// Normals where a file gives none.
#pragma once

#include "precompute/scene/polygons/polygon_mesh.h"
#include "precompute/scene/polygons/triangulation.h"

#include <vector>

namespace relume::scene {

// Gives a normal to every corner of the triangles that has none, by the smoothing of its
// polygon: weighted by area, over the faces at the same place that belong together. Corners
// that need different normals at one place get them. Returns how many corners were without.
std::size_t add_missing_normals(PolygonMesh& mesh, std::vector<CornerTriangle>& triangles);

}  // namespace relume::scene
