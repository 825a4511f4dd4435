#include "precompute/scene/gltf/document.h"

#include "precompute/scene/gltf/extensions.h"
#include "precompute/scene/gltf/json_text.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <utility>

namespace relume::scene::gltf {
namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";

[[noreturn]] void refuse(const FileName& file, const std::string& why) {
    file.refuse(SceneFault::corrupt_file, why);
}

// The member as an array; empty where there is none.
json taken_array(json& object, const char* member, const FileName& file) {
    const auto found = object.find(member);
    if (found == object.end())
        return json::array();
    if (!found->is_array())
        refuse(file, fmt::format("'{}' is no array", member));
    json array = std::move(*found);
    object.erase(found);
    return array;
}

std::optional<std::string> string_of(const json& object, const char* member) {
    const auto found = object.find(member);
    if (found == object.end() || !found->is_string())
        return std::nullopt;
    return found->get<std::string>();
}

std::vector<BufferSource> buffers_of(const json& array, const FileName& file) {
    std::vector<BufferSource> buffers;
    for (const json& buffer : array) {
        const auto length = buffer.find("byteLength");
        if (!buffer.is_object() || length == buffer.end() || !length->is_number_unsigned())
            refuse(file, fmt::format("buffer {} has no byteLength; expected a whole number",
                                     buffers.size()));
        buffers.push_back(
            {.uri = string_of(buffer, "uri"), .byte_length = length->get<std::uint64_t>()});
    }
    return buffers;
}

std::vector<ImageSource> images_of(const json& array, const FileName& file) {
    std::vector<ImageSource> images;
    for (const json& image : array) {
        if (!image.is_object())
            refuse(file, fmt::format("image {} is no object", images.size()));
        ImageSource source{.name = string_of(image, "name").value_or(""),
                           .uri = string_of(image, "uri")};
        if (const auto view = image.find("bufferView");
            view != image.end() && view->is_number_integer())
            source.buffer_view = view->get<int>();
        if (!source.uri && !source.buffer_view)
            refuse(file, fmt::format("image {} has neither uri nor bufferView; expected one",
                                     images.size()));
        images.push_back(std::move(source));
    }
    return images;
}

// tinygltf 2.7 insists on a buffer view behind `indices`, which a Draco primitive need not
// have.
void move_draco_indices(json& meshes) {
    for (json& mesh : meshes) {
        if (!mesh.is_object() || !mesh.contains("primitives"))
            continue;
        for (json& primitive : mesh["primitives"]) {
            if (!primitive.is_object() || !primitive.contains("indices"))
                continue;
            const auto extensions = primitive.find("extensions");
            if (extensions == primitive.end() || !extensions->is_object() ||
                !extensions->contains(kDraco) || !(*extensions)[kDraco].is_object())
                continue;
            (*extensions)[kDraco]["indices"] = primitive["indices"];
            primitive.erase("indices");
        }
    }
}

// tinygltf drops a primitive that it cannot read, and says so only in its messages.
void check_counts(const json& document, const Document& parsed, const std::string& messages) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end() || !meshes->is_array())
        return;
    for (std::size_t i = 0; i < parsed.model.meshes.size(); ++i) {
        const json& mesh = (*meshes)[i];
        const std::size_t stated = mesh.contains("primitives") ? mesh["primitives"].size() : 0;
        if (parsed.model.meshes[i].primitives.size() != stated)
            refuse(parsed.file, fmt::format("mesh {} has a primitive that is none: {}", i,
                                            shown_text(messages)));
    }
}

}  // namespace

std::string label(const char* kind, std::size_t index, const std::string& name) {
    return name.empty()
               ? fmt::format("{} {}", kind, index)
               : fmt::format("{} {} '{}'", kind, index, shown_text(original_bytes(name)));
}

Document parse_document(const Container& container, const FileName& file) {
    Document parsed{.file = file};
    json document = parse_json(container.json(), file);
    parsed.extensions = extensions_of(document, file);
    parsed.buffers = buffers_of(taken_array(document, "buffers", file), file);
    parsed.images = images_of(taken_array(document, "images", file), file);
    if (const auto meshes = document.find("meshes"); meshes != document.end())
        move_draco_indices(*meshes);
    const std::string text = document.dump();
    std::string errors;
    std::string warnings;
    bool is_read = false;
    try {
        tinygltf::TinyGLTF reader;
        is_read = reader.LoadASCIIFromString(&parsed.model, &errors, &warnings, text.data(),
                                             static_cast<unsigned>(text.size()), std::string());
    } catch (const std::exception& error) {
        errors += error.what();
    }
    while (!errors.empty() && errors.back() == '\n')
        errors.pop_back();
    if (!is_read)
        refuse(file, fmt::format("no glTF 2.0: {}", shown_text(errors)));
    if (!parsed.model.asset.version.starts_with("2."))
        refuse(file, fmt::format("glTF version '{}'; expected 2.x",
                                 shown_text(parsed.model.asset.version)));
    check_counts(document, parsed, errors);
    return parsed;
}

}  // namespace relume::scene::gltf
