// EXT_meshopt_compression: buffer views that meshoptimizer's decoder unpacks.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace relume::scene::gltf {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

struct MeshoptView {
    enum class Mode : std::uint8_t { attributes, triangles, indices };
    enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential };

    int buffer = -1;
    std::size_t offset = 0;
    std::size_t length = 0;
    std::size_t stride = 0;  // bytes of an element, unpacked
    std::size_t count = 0;
    Mode mode = Mode::attributes;
    Filter filter = Filter::none;
};

// Throws SceneError (corrupt_file) where a member is missing or has a value that the extension
// does not allow. `who` names the buffer view.
[[nodiscard]] MeshoptView meshopt_view(const tinygltf::Value& extension,
                                       const FileName& file,
                                       const std::string& who);

// count·stride bytes. Throws SceneError (corrupt_file) for bytes that are no such stream, or
// that cannot hold as many elements as stated.
[[nodiscard]] std::vector<std::uint8_t> decompressed(const MeshoptView& view,
                                                     std::span<const std::uint8_t> packed,
                                                     const FileName& file,
                                                     const std::string& who);

}  // namespace relume::scene::gltf
