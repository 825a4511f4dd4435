#include "server/scene/scene_part.h"

#include "protocol/base/text/material_ids.h"

namespace relume::served {

std::vector<ScenePart> parts_of(std::span<const transport::MaterialRecord> materials) {
    text::MaterialIds ids;
    std::vector<ScenePart> parts;
    parts.reserve(materials.size());
    for (const transport::MaterialRecord& material : materials) {
        parts.push_back({.id = ids.next(material.name), .name = material.name});
    }
    return parts;
}

}  // namespace relume::served
