#include "precompute/scene/gltf/extensions.h"

#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace relume::scene::gltf {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 11> kSupported{
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

// They describe the file and change no picture.
constexpr std::array<std::string_view, 4> kMetadata{"EXT_structural_metadata", "KHR_xmp",
                                                    "KHR_xmp_json_ld",
                                                    "MSFT_packing_occlusionRoughnessMetallic"};

struct Known {
    std::string_view name;
    std::string_view words;
    std::string_view factor{};  // zero, which is its default, switches the extension off
};

constexpr std::array<Known, 8> kMaterials{{
    {"KHR_materials_anisotropy", "anisotropy", "anisotropyStrength"},
    {"KHR_materials_clearcoat", "clear coat", "clearcoatFactor"},
    {"KHR_materials_diffuse_transmission", "diffuse transmission (taken as opaque)",
     "diffuseTransmissionFactor"},
    {"KHR_materials_dispersion", "dispersion", "dispersion"},
    {"KHR_materials_iridescence", "iridescence", "iridescenceFactor"},
    {"KHR_materials_sheen", "sheen", "sheenColorFactor"},
    {"KHR_materials_transmission", "transmission (taken as opaque)", "transmissionFactor"},
    {"KHR_materials_volume", "volume", "thicknessFactor"},
}};

constexpr std::array<Known, 6> kElsewhere{{
    {"KHR_animation_pointer", "animations (the file's pose is shown)"},
    {"KHR_lights_punctual", "lights"},
    {"KHR_materials_variants", "variants (the default one is shown)"},
    {"KHR_node_visibility", "hidden nodes (they are shown)"},
    {"KHR_texture_basisu", "Basis Universal pictures"},
    {"MSFT_lod", "levels of detail (the first is shown)"},
}};

template <typename Table>
bool holds(const Table& table, const std::string& name) {
    return std::find(table.begin(), table.end(), name) != table.end();
}

template <typename Table>
const Known* known(const Table& table, const std::string& name) {
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const Known& entry) { return entry.name == name; });
    return found == table.end() ? nullptr : &*found;
}

std::string shown(const std::string& name) {
    return shown_text(original_bytes(name));
}

bool is_zero(const tinygltf::Value& value) {
    if (value.IsArray()) {
        for (std::size_t i = 0; i < value.ArrayLen(); ++i) {
            if (!is_zero(value.Get(static_cast<int>(i))))
                return false;
        }
        return true;
    }
    return !value.IsNumber() || value.GetNumberAsDouble() == 0;
}

// Every key of every object `extensions`; what `extras` hold is the exporter's own.
void collect(const json& value, std::set<std::string>& names) {
    if (value.is_array()) {
        for (const json& element : value)
            collect(element, names);
    } else if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            if (key == "extensions" && member.is_object()) {
                for (const auto& extension : member.items())
                    names.insert(extension.key());
            }
            if (key != "extras")
                collect(member, names);
        }
    }
}

std::vector<std::string> listed(const json& document,
                                const char* member,
                                const FileName& file) {
    std::vector<std::string> names;
    const auto found = document.find(member);
    if (found == document.end())
        return names;
    const auto is_text = [](const json& name) { return name.is_string(); };
    if (!found->is_array() || !std::all_of(found->begin(), found->end(), is_text))
        file.refuse(SceneFault::corrupt_file, fmt::format("'{}' is no array of names", member));
    return found->get<std::vector<std::string>>();
}

}  // namespace

std::set<std::string> extensions_of(const json& document, const FileName& file) {
    std::set<std::string> names;
    for (const std::string& name : listed(document, "extensionsRequired", file)) {
        if (!holds(kSupported, name))
            file.refuse(SceneFault::unsupported_extension,
                        fmt::format("requires the extension '{}', which is not supported; "
                                    "expected one of {}",
                                    shown(name), fmt::join(kSupported, ", ")));
        names.insert(name);
    }
    for (std::string& name : listed(document, "extensionsUsed", file))
        names.insert(std::move(name));
    collect(document, names);
    return names;
}

std::vector<std::string> unused_material_extensions(const tinygltf::ExtensionMap& extensions) {
    std::vector<std::string> unused;
    for (const auto& [name, value] : extensions) {
        const Known* entry = known(kMaterials, name);
        if (entry == nullptr ||
            (value.IsObject() && is_zero(value.Get(std::string(entry->factor)))))
            continue;
        unused.push_back(fmt::format("{} ({})", entry->words, name));
    }
    return unused;
}

std::vector<std::string> unused_extensions(const std::set<std::string>& extensions) {
    std::vector<std::string> unused;
    for (const std::string& name : extensions) {
        if (holds(kSupported, name) || holds(kMetadata, name) ||
            known(kMaterials, name) != nullptr)
            continue;
        const Known* entry = known(kElsewhere, name);
        unused.push_back(fmt::format("extension '{}': {}", shown(name),
                                     entry == nullptr ? "not supported" : entry->words));
    }
    return unused;
}

}  // namespace relume::scene::gltf
