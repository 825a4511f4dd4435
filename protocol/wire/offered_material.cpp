#include "protocol/wire/offered_material.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/finishes.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

using nlohmann::json;

const json& array_of(const json& value, const std::string& path) {
    if (!value.is_array()) {
        throw WireError(ErrorCode::wrong_type, path, quote(value), "an array");
    }
    return value;
}

}  // namespace

json to_json(const OfferedMaterial& material) {
    json object = {{"name", material.name},
                   {"face_resolution", material.face_resolution},
                   {"colours", json::array()}};
    for (const Imath::V3d& colour : material.colours) {
        object["colours"].push_back({colour.x, colour.y, colour.z});
    }
    if (material.parameter) {
        object["parameter"] = *material.parameter;
        object["steps"] = material.steps;
    }
    return object;
}

OfferedMaterial offered_material_from_json(const json& object, const std::string& path) {
    ObjectReader reader(object, path);
    OfferedMaterial material{
        .name = name_from_json(reader.require("name"), reader.path_to("name")),
        .face_resolution = static_cast<std::uint32_t>(integer_from_json(
            reader.require("face_resolution"), reader.path_to("face_resolution"), 0, 1U << 16)),
        .colours = {}};
    const auto each = [&](const char* key, const auto& take) {
        const std::string at = reader.path_to(key);
        const json& values = array_of(reader.require(key), at);
        for (std::size_t i = 0; i < values.size(); ++i) {
            take(values[i], pointer_step(at, std::to_string(i)));
        }
    };
    each("colours", [&](const json& colour, const std::string& at) {
        material.colours.push_back(vector_from_json(colour, at, kColour));
    });
    if (const json* parameter = reader.find("parameter")) {
        material.parameter = string_from_json(*parameter, reader.path_to("parameter"));
        each("steps", [&](const json& step, const std::string& at) {
            material.steps.push_back(number_from_json(step, at, {0, 1e5}));
        });
    }
    return material;
}

}  // namespace relume::wire
