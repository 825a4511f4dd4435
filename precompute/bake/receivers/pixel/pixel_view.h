// What one pixel sees: usually one surface; at silhouettes several, each with its share.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/receivers/receiver.h"
#include "precompute/scene/camera.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <vector>

namespace relume::bake {

struct PixelView {
    std::vector<ReceiverSurface> surfaces;  // shares add up to `coverage`
    float coverage = 0;                     // part of the pixel that sees the scene, in [0, 1]
    float depth = 0;  // along the view axis, average over the covered part; 0 where none
    Imath::V3f albedo{0, 0, 0};  // diffuse plus specular colour, times coverage
};

// Casts a ray through the middle of the pixel and `pixel_samples` more on a jittered grid;
// where they, or rays through the pixel's corners, do not all meet one smooth surface, an edge
// passes, and kEdgeFactor times as many follow, for shares and coverage are what shows there.
// Rays that meet one smooth surface are gathered into one ReceiverSurface, whose textures are
// averaged. Corners count for nothing but the decision; an edge that all of these miss stays
// unseen, so that what a pixel shows of it is a little less than it should be on average. One
// sample is the middle alone, whatever is around it. Depends on nothing but its arguments.
inline constexpr std::uint32_t kEdgeFactor = 8;
[[nodiscard]] PixelView view_pixel(const RayCaster& caster,
                                   const scene::Camera& camera,
                                   std::uint32_t x,
                                   std::uint32_t y,
                                   std::uint32_t pixel_samples,
                                   std::uint64_t seed);

}  // namespace relume::bake
