#include "protocol/wire/editable_material.h"

#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/section_json.h"

#include <nlohmann/json.hpp>

namespace relume::wire {

using nlohmann::json;

json to_json(const EditableMaterial& material) {
    return {{"id", material.id},
            {"name", material.name},
            {"curve", material.curve},
            {"angle", material.angle},
            {"shapes", material.shapes},
            {"presets", material.presets},
            {"baked", to_json(kMaterials.entry, material.baked)}};
}

EditableMaterial editable_material_from_json(const json& object, const std::string& path) {
    ObjectReader reader(object, path);
    const auto text = [&](const char* key) {
        return string_from_json(reader.require(key), reader.path_to(key));
    };
    EditableMaterial material{
        .id = name_from_json(reader.require("id"), reader.path_to("id")),
        .name = text("name"),
        .curve = text("curve"),
        .angle = text("angle"),
        .shapes = strings_from_json(reader.require("shapes"), reader.path_to("shapes")),
        .presets = strings_from_json(reader.require("presets"), reader.path_to("presets")),
        .baked = {}};
    SectionPatch<MaterialEdit> baked(kMaterials.entry, reader.require("baked"),
                                     reader.path_to("baked"));
    baked.require_needed();
    static_cast<void>(baked.apply(material.baked));
    return material;
}

}  // namespace relume::wire
