// Parts of a scene that may be given other materials than they were baked with.
#pragma once

#include "protocol/transport/mesh_section.h"

#include <span>
#include <string>
#include <vector>

namespace relume::served {

struct ScenePart {
    std::string id;    // by which rooms call it; a name, used once
    std::string name;  // of its material in the scene's file
};

// A part for each material of a surface, in their order.
[[nodiscard]] std::vector<ScenePart> parts_of(
    std::span<const transport::MaterialRecord> materials);

}  // namespace relume::served
