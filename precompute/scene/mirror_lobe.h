// Where a glossy surface reflects to, and how sharply.
#pragma once

#include "precompute/scene/surface_point.h"

#include <Imath/ImathVec.h>

namespace relume::scene {

// Unit, world.
[[nodiscard]] Imath::V3f mirror_direction(const SurfacePoint& point);

// How narrow the glossy lobe is in its narrowest direction, in radians of the light's
// direction. A half vector's spread is doubled in the plane of incidence and shrinks with the
// cosine across. Of Lambert points it means nothing.
[[nodiscard]] float lobe_width(const SurfacePoint& point);

}  // namespace relume::scene
