// Tangents for normal maps, where a file gives none.
#pragma once

#include "precompute/scene/mesh.h"

#include <cstddef>

namespace relume::scene {

// Gives the mesh tangents along the texture coordinates of `uv_set`, in the manner of
// MikkTSpace [Mikkelsen08]: at a corner, the mean over the triangles around it of their
// tangents, by angle, mirrored ones apart. Corners that need two tangents become two vertices;
// a mesh that is shaded flat gets three vertices for each triangle. Where the coordinates span
// no direction the tangent is zero and the normal map has no effect.
void add_tangents(Mesh& mesh, std::size_t uv_set);

}  // namespace relume::scene
