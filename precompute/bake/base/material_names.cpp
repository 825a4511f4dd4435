#include "precompute/bake/base/material_names.h"

#include "protocol/base/text/names.h"
#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <vector>

namespace relume::bake {

std::optional<std::uint32_t> find_material(const scene::Scene& scene, std::string_view name) {
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == name) {
            return i;
        }
    }
    return std::nullopt;
}

std::string no_such_material(const std::string& option,
                             const std::string& name,
                             const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const scene::Material& material : scene.materials) {
        names.push_back(material.name);
    }
    return fmt::format("{}: the scene has no such material, expected {}", option,
                       text::expected_name(name, names, "materials"));
}

}  // namespace relume::bake
