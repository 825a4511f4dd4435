// A glTF document: what tinygltf makes of its JSON, and the places of its buffers and images.
#pragma once

#include "precompute/scene/gltf/container.h"
#include "precompute/scene/gltf/fault.h"

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// Bytes by URI, as it stands in the file.
struct BufferSource {
    std::optional<std::string> uri{};  // none: the binary chunk, or a fallback without bytes
    std::uint64_t byte_length = 0;
};

// One of the two is there.
struct ImageSource {
    std::string name{};
    std::optional<std::string> uri{};
    std::optional<int> buffer_view{};
};

struct Document {
    FileName file;
    // Without `buffers` and `images`: tinygltf would open any path, take only some media types
    // in data URIs, and read image bytes without looking at their range. A primitive that is
    // compressed by Draco has its `indices` in `draco_indices` instead.
    tinygltf::Model model{};
    std::vector<BufferSource> buffers{};
    std::vector<ImageSource> images{};
    std::set<std::string> extensions{};  // used anywhere, or said to be used
};

// Throws SceneError: corrupt_file for what is no glTF 2.0; unsupported_extension where the file
// requires one that is not supported.
[[nodiscard]] Document parse_document(const Container& container, const FileName& file);

// "mesh 3 'chair'", escaped; the name is left out where there is none.
[[nodiscard]] std::string label(const char* kind, std::size_t index, const std::string& name);

}  // namespace relume::scene::gltf
