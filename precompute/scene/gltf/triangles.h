// From the corners that a primitive lists to triangles and the vertices they have.
#pragma once

#include "precompute/scene/mesh.h"

#include <cstdint>
#include <vector>

namespace relume::scene::gltf {

// Triangles of a list, a strip or a fan of corners, all wound alike (glTF 2.0 §3.7.2.1). `mode`
// is one of TINYGLTF_MODE_TRIANGLES, …_TRIANGLE_STRIP and …_TRIANGLE_FAN.
[[nodiscard]] std::vector<Triangle> triangles_of(int mode,
                                                 const std::vector<std::uint32_t>& corners);

// Renumbers the triangles' vertices, all below `count`, without gaps. Returns the former number
// of each, ascending: many primitives may share one long list of vertices.
[[nodiscard]] std::vector<std::uint32_t> take_used_vertices(std::vector<Triangle>& triangles,
                                                            std::size_t count);

}  // namespace relume::scene::gltf
