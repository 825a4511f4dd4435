// Which texture coordinates a material's textures want, and how KHR_texture_transform moves
// them.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <Imath/ImathVec.h>
#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// One set of TEXCOORD_n, moved. glTF's v grows downwards, the scene's upwards; both are here.
struct UvSource {
    int texcoord = 0;
    // u' = m[0]·u + m[1]·v + m[2], v' = m[3]·u + m[4]·v + m[5], v downwards.
    std::array<double, 6> map{1, 0, 0, 0, 1, 0};

    [[nodiscard]] bool operator==(const UvSource&) const = default;
    // Coordinates of the scene (v upwards) from those of the file (v downwards).
    [[nodiscard]] Imath::V2f uv_from_file(float u, float v) const;
};

// The sets of one material, at most kMaxUvSets.
using UvSources = std::vector<UvSource>;

// The set of a texture info: its texCoord, or that of its KHR_texture_transform. Throws
// SceneError (corrupt_file) for numbers that are missing in a list or not finite.
[[nodiscard]] UvSource uv_source_of(int texcoord,
                                    const tinygltf::ExtensionMap& extensions,
                                    const FileName& file,
                                    const std::string& who);

// The place of `source` in `sources`, added where it is new. Throws SceneError (too_large)
// above kMaxUvSets.
[[nodiscard]] std::uint32_t uv_set_of(const UvSource& source,
                                      UvSources& sources,
                                      const FileName& file,
                                      const std::string& who);

}  // namespace relume::scene::gltf
