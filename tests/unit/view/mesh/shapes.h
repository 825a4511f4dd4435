// Surface meshes to look at.
#pragma once

#include "protocol/transport/surface_mesh.h"
#include "server/view/mesh/pixel_space.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::view {

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
// A pinhole with a field of view upwards and a square image.
[[nodiscard]] Pinhole pinhole_at(const Imath::V3d& eye,
                                 const Imath::V3d& look_at,
                                 double fov_degrees);

}  // namespace relume::view
