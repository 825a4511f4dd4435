// Matte scenes under a sky of radiance 1, by rays alone: what light between vertices is
// compared with.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/scene/scene.h"
#include "server/view/view.h"
#include "tests/stability/relit_image.h"

#include <Imath/ImathVec.h>

namespace relume::stability {

// The part of the sky over a surface that is seen from a point just off it, weighed by the
// cosine: what a white surface shows there. By 256 directions, the same for all points.
[[nodiscard]] double open_part(const bake::RayCaster& caster,
                               const Imath::V3f& origin,
                               const Imath::V3f& normal);

// Direct light on flat surfaces, one place a pixel, with base colours of materials; black where
// nothing is.
[[nodiscard]] RelitImage image_under_white_sky(const scene::Scene& scene,
                                               const view::Look& look);

}  // namespace relume::stability
