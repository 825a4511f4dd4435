#include "protocol/wire/scene_summary.h"

#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/limits.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/section_json.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxCount = std::numeric_limits<std::uint32_t>::max();

std::uint32_t count_from(ObjectReader& reader, const char* key) {
    return static_cast<std::uint32_t>(
        integer_from_json(reader.require(key), reader.path_to(key), 0, kMaxCount));
}

// What an older server does not say is left as it is.
void read_count(ObjectReader& reader, const char* key, std::uint32_t& value) {
    if (reader.find(key) != nullptr) {
        value = count_from(reader, key);
    }
}
void read_bytes(ObjectReader& reader, const char* key, std::uint64_t& value) {
    if (const json* found = reader.find(key)) {
        value = integer_from_json(*found, reader.path_to(key), 0, kMaxInteger);
    }
}
void read_text(ObjectReader& reader, const char* key, std::string& value) {
    if (const json* found = reader.find(key)) {
        value = string_from_json(*found, reader.path_to(key));
    }
}

// Calls take(element, its pointer) for each of an array, where there is one.
template <typename Take>
void read_each(ObjectReader& reader, const char* key, const Take& take) {
    const json* const values = reader.find(key);
    if (values == nullptr) {
        return;
    }
    const std::string path = reader.path_to(key);
    if (!values->is_array()) {
        throw WireError(ErrorCode::wrong_type, path, quote(*values),
                        std::string("an array of ") + key);
    }
    for (std::size_t i = 0; i < values->size(); ++i) {
        take((*values)[i], pointer_step(path, std::to_string(i)));
    }
}

ScenePart part_from_json(const json& object, const std::string& path) {
    ObjectReader reader(object, path);
    return {.id = name_from_json(reader.require("id"), reader.path_to("id")),
            .name = string_from_json(reader.require("name"), reader.path_to("name"))};
}

Camera camera_from_json(const json& object, const std::string& path) {
    Camera camera;
    ObjectReader reader(object, path);
    for (const Field<Camera>& field : kCameraFields) {
        const json& value = reader.require(field.rule.key);
        field.set(camera, value_from_json(field.rule, value, reader.path_to(field.rule.key)));
    }
    return camera;
}

json to_json(const SceneBounds& bounds) {
    return {{"centre", {bounds.centre.x, bounds.centre.y, bounds.centre.z}},
            {"radius", bounds.radius}};
}

SceneBounds bounds_from_json(const json& object, const std::string& path) {
    ObjectReader reader(object, path);
    const json& centre = reader.require("centre");
    const json& radius = reader.require("radius");
    return {
        .centre = vector_from_json(centre, reader.path_to("centre"), kPosition),
        .radius = number_from_json(radius, reader.path_to("radius"), {0, kPosition.highest})};
}

}  // namespace

json to_json(const SceneSummary& scene) {
    json object = {{"name", scene.name},       {"kind", scene.kind},
                   {"width", scene.width},     {"height", scene.height},
                   {"basis", scene.basis},     {"face_resolution", scene.face_resolution},
                   {"columns", scene.columns}, {"channels", scene.channels},
                   {"bytes", scene.bytes},     {"memory_bytes", scene.memory_bytes},
                   {"edits", scene.edits}};
    if (scene.order) {
        object["order"] = *scene.order;
    }
    if (scene.bake_error) {
        object["bake_error"] = *scene.bake_error;
    }
    if (scene.camera) {
        object["camera"] = to_json(kCamera, *scene.camera);
    }
    if (scene.bounds) {
        object["bounds"] = to_json(*scene.bounds);
    }
    for (const EditableMaterial& material : scene.materials) {
        object["materials"].push_back(to_json(material));
    }
    if (scene.visibility_resolution) {
        object["visibility_resolution"] = *scene.visibility_resolution;
    }
    for (const ScenePart& part : scene.parts) {
        object["parts"].push_back({{"id", part.id}, {"name", part.name}});
    }
    return object;
}

SceneSummary scene_summary_from_json(const json& object, const std::string& path) {
    ObjectReader reader(object, path);
    SceneSummary scene{.name = name_from_json(reader.require("name"), reader.path_to("name")),
                       .width = count_from(reader, "width"),
                       .height = count_from(reader, "height"),
                       .order = {},
                       .face_resolution = count_from(reader, "face_resolution"),
                       .bake_error = {},
                       .camera = {},
                       .bounds = {},
                       .materials = {},
                       .visibility_resolution = {},
                       .parts = {},
                       .edits = {}};
    read_text(reader, "kind", scene.kind);
    read_text(reader, "basis", scene.basis);
    read_count(reader, "columns", scene.columns);
    read_count(reader, "channels", scene.channels);
    read_bytes(reader, "bytes", scene.bytes);
    read_bytes(reader, "memory_bytes", scene.memory_bytes);
    if (reader.find("order") != nullptr) {
        scene.order = count_from(reader, "order");
    }
    if (const json* error = reader.find("bake_error")) {
        scene.bake_error = number_from_json(*error, reader.path_to("bake_error"), {0, 1e6});
    }
    if (const json* camera = reader.find("camera")) {
        scene.camera = camera_from_json(*camera, reader.path_to("camera"));
    }
    if (const json* bounds = reader.find("bounds")) {
        scene.bounds = bounds_from_json(*bounds, reader.path_to("bounds"));
    }
    if (const json* edits = reader.find("edits")) {
        scene.edits = strings_from_json(*edits, reader.path_to("edits"));
    }
    read_each(reader, "materials", [&](const json& material, const std::string& at) {
        scene.materials.push_back(editable_material_from_json(material, at));
    });
    if (reader.find("visibility_resolution") != nullptr) {
        scene.visibility_resolution = count_from(reader, "visibility_resolution");
    }
    read_each(reader, "parts", [&](const json& part, const std::string& at) {
        scene.parts.push_back(part_from_json(part, at));
    });
    return scene;
}

}  // namespace relume::wire
