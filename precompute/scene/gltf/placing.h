// Shapes put into the world.
#pragma once

#include "precompute/scene/gltf/affine.h"
#include "precompute/scene/gltf/primitives.h"
#include "precompute/scene/imported_scene.h"

#include <span>
#include <string>

namespace relume::scene::gltf {

// Appends the shape as a mesh `name` of the scene. `to_world` has one map for all its vertices,
// or one for each. A map that mirrors turns the triangles over, so that their outside stays
// outside, and the tangents' sides, so that a bump stays a bump.
void place(PrimitiveShape shape,
           std::span<const Affine> to_world,
           const std::string& name,
           ImportedScene& imported);

}  // namespace relume::scene::gltf
