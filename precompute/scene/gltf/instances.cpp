#include "precompute/scene/gltf/instances.h"

#include <fmt/format.h>

#include <optional>
#include <string>

namespace relume::scene::gltf {

std::vector<Affine> instances_of(const Document& document,
                                 std::size_t index,
                                 Accessors& accessors,
                                 std::uint64_t most) {
    const tinygltf::Node& node = document.model.nodes[index];
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end())
        return {Affine()};
    const std::string self = label("node", index, node.name);
    const auto refuse = [&](SceneFault fault, const std::string& why) {
        document.file.refuse(fault, fmt::format("instances of {}: {}", self, why));
    };
    const tinygltf::Value nothing;
    const tinygltf::Value& attributes = extension->second.IsObject()
                                            ? extension->second.Get(std::string("attributes"))
                                            : nothing;
    if (!attributes.IsObject())
        refuse(SceneFault::corrupt_file, "no attributes");
    std::optional<std::size_t> count;
    const auto elements = [&](const char* name, std::size_t width) -> std::optional<Elements> {
        const tinygltf::Value& accessor = attributes.Get(std::string(name));
        if (!accessor.IsNumber())
            return std::nullopt;
        Elements found = accessors.elements(accessor.GetNumberAsInt(), {width},
                                            fmt::format("{} of {}", name, self));
        if (count && found.count() != *count)
            refuse(SceneFault::corrupt_file,
                   fmt::format("{} has {} elements; expected {}", name, found.count(), *count));
        count = found.count();
        return found;
    };
    const auto translations = elements("TRANSLATION", 3);
    const auto rotations = elements("ROTATION", 4);
    const auto scales = elements("SCALE", 3);
    if (!count)
        refuse(SceneFault::corrupt_file,
               "no TRANSLATION, ROTATION or SCALE; expected at least one of them");
    if (*count > most)
        refuse(SceneFault::too_large,
               fmt::format("{} of them; expected at most {}", *count, most));
    const auto triple = [](const std::optional<Elements>& of, std::size_t i, double otherwise) {
        return of ? Imath::V3d(of->number(i, 0), of->number(i, 1), of->number(i, 2))
                  : Imath::V3d(otherwise);
    };
    std::vector<Affine> maps;
    maps.reserve(*count);
    for (std::size_t i = 0; i < *count; ++i) {
        const Imath::V4d rotation =
            rotations ? Imath::V4d(rotations->number(i, 0), rotations->number(i, 1),
                                   rotations->number(i, 2), rotations->number(i, 3))
                      : Imath::V4d(0, 0, 0, 1);
        maps.push_back(affine_from(triple(translations, i, 0), rotation, triple(scales, i, 1)));
    }
    return maps;
}

}  // namespace relume::scene::gltf
