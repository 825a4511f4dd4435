// A material of the scene that people edit under any light, as a transport has it.
#pragma once

#include "precompute/bake/base/field_request.h"
#include "precompute/scene/scene.h"
#include "protocol/transport/materials_section.h"

#include <cstdint>
#include <vector>

namespace relume::bake {

struct EditableMaterial {
    std::uint32_t material = 0;  // index into the scene's materials
    transport::EditableRecord record;
    // Textures change its specular part from point to point. The record's has none, so that an
    // edit starts from another highlight than the one that is seen.
    bool has_specular_textures = false;
};

// In the order of the request, with IDs as `--edit` gives them. Throws program::UsageError for
// a name that no material has, naming those that are near.
[[nodiscard]] std::vector<EditableMaterial> editable_materials(const scene::Scene& scene,
                                                               const FieldRequest& request);

}  // namespace relume::bake
