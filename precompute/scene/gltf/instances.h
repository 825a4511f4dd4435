// EXT_mesh_gpu_instancing: one mesh in many places of one node.
#pragma once

#include "precompute/scene/gltf/accessors.h"
#include "precompute/scene/gltf/affine.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relume::scene::gltf {

// The maps of the instances to the node's coordinates; the one that changes nothing for a node
// that has no instances of its own. Throws SceneError: corrupt_file where attributes differ in
// length, too_large above `most`.
[[nodiscard]] std::vector<Affine> instances_of(const Document& document,
                                               std::size_t node,
                                               Accessors& accessors,
                                               std::uint64_t most);

}  // namespace relume::scene::gltf
