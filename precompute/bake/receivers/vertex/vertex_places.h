// Where the light of a vertex is looked for: places on the triangles around it.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/vertex/refined_surface.h"
#include "precompute/scene/scene.h"
#include "precompute/scene/surface_point.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>

namespace relume::bake {

// A place on the scene, seen from one of its two sides.
struct SurfacePlace {
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    bool is_behind = false;
    Imath::V2f barycentric{0, 0};  // as scene::surface_point takes it
};

// How far inside its triangle a place lies, as a part of the way from the vertex to the
// triangle's middle: in a corner between walls a ray from the vertex itself would start in all
// three, and might pass any of them.
inline constexpr float kPlaceInset = 0.04F;

// Sixteen places around a vertex, from which a packet of rays leaves: so many on each triangle
// as its angle at the vertex asks for, in turn, so that any aligned run of 2^k is spread over
// the triangles. Deterministic and thread-safe.
[[nodiscard]] std::array<SurfacePlace, kPacketSize> places_of_vertex(
    const RefinedSurface& surface, std::size_t vertex);

// The scene's point at a place, seen along the normal of its triangle.
[[nodiscard]] scene::SurfacePoint surface_point_at(const scene::Scene& scene,
                                                   const SurfacePlace& place);

}  // namespace relume::bake
