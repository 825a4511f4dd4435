// The JSON of a glTF file, parsed with bounds.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace relume::scene::gltf {

// Throws SceneError: corrupt_file for bad syntax, for more than 64 levels, and where the text
// is no object; too_large for more than 512 MiB. JSON is UTF-8; a byte that is none stands in a
// name that some exporter wrote in a code page, and such a name must not lose the scene: it
// becomes a private character, which `original_bytes` turns back.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const FileName& file);

// A string of the parsed document as the bytes that stood in the file.
[[nodiscard]] std::string original_bytes(std::string_view text);

}  // namespace relume::scene::gltf
