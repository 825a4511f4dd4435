// Meshes of a transport of kind `mesh`, to look at.
#pragma once

#include "protocol/transport/surface_mesh.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::test {

// The inside of a cube of side 2 around the origin, each face cut into cells² squares that do
// not lie in a lattice. Every direction from inside meets a front. Face f has material f of
// `materials`, modulo that.
[[nodiscard]] transport::SurfaceMesh room(std::uint32_t cells, std::uint32_t materials = 1);
// Its outside, of another size, somewhere else.
[[nodiscard]] transport::SurfaceMesh box(std::uint32_t cells,
                                         const Imath::V3f& centre,
                                         float half_side);
// Both, the second one's vertices after the first one's.
[[nodiscard]] transport::SurfaceMesh together(transport::SurfaceMesh first,
                                              const transport::SurfaceMesh& second);
}  // namespace relume::test
