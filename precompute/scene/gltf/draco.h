// KHR_draco_mesh_compression: triangles and attributes that Draco's decoder unpacks.
#pragma once

#include "precompute/scene/gltf/accessors.h"
#include "precompute/scene/gltf/document.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace relume::scene::gltf {

struct DracoMesh {
    std::vector<std::uint32_t> indices;          // three for each triangle
    std::map<std::string, Elements> attributes;  // by name: POSITION, …
};

[[nodiscard]] bool is_draco(const tinygltf::Primitive& primitive);

// The primitive's triangles, and those of its attributes that the compressed mesh has; integers
// become numbers as the primitive's accessors say. `who` names the primitive. Throws SceneError
// (corrupt_file).
[[nodiscard]] DracoMesh decode_draco(const tinygltf::Primitive& primitive,
                                     const Document& document,
                                     BufferViews& views,
                                     const std::string& who);

}  // namespace relume::scene::gltf
