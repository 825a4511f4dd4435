// The glTF extensions: which are read, and what those that are not would have changed.
#pragma once

#include "precompute/scene/gltf/fault.h"

#include <nlohmann/json_fwd.hpp>
#include <tiny_gltf.h>

#include <set>
#include <string>
#include <vector>

namespace relume::scene::gltf {

// Names of all extensions that the document says it uses or uses without saying. Throws
// SceneError (unsupported_extension) where it requires one that is not supported, whatever it
// would change.
[[nodiscard]] std::set<std::string> extensions_of(const nlohmann::json& document,
                                                  const FileName& file);

// What of a material's extensions the bake leaves out, in words that name the extension; those
// whose own factor switches them off are no loss and not named.
[[nodiscard]] std::vector<std::string> unused_material_extensions(
    const tinygltf::ExtensionMap& extensions);

// What of `extensions` the bake leaves out, but for those of materials. Metadata is no loss and
// not named.
[[nodiscard]] std::vector<std::string> unused_extensions(
    const std::set<std::string>& extensions);

}  // namespace relume::scene::gltf
