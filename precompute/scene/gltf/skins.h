// Skins: vertices that joints move, in the pose that the file's nodes have.
#pragma once

#include "precompute/scene/gltf/accessors.h"
#include "precompute/scene/gltf/nodes.h"
#include "precompute/scene/gltf/primitives.h"

#include <cstddef>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// For each joint, the map of the mesh's coordinates to the world: inverse bind matrix, then the
// joint's node. The node of the mesh has no part in it (glTF 2.0 §3.7.3.2). Throws SceneError
// (corrupt_file).
[[nodiscard]] std::vector<Affine> joint_maps(const Document& document,
                                             std::size_t skin,
                                             const Nodes& nodes,
                                             Accessors& accessors);

// For each vertex, the mean of the maps of its joints by weight; of a vertex without weight,
// the map of its first joint. `who` names the primitive. Throws SceneError (corrupt_file).
[[nodiscard]] std::vector<Affine> vertex_maps(const Influences& influences,
                                              const std::vector<Affine>& joints,
                                              const FileName& file,
                                              const std::string& who);

}  // namespace relume::scene::gltf
