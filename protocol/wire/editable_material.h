// A material of a scene of kind `curves`, as clients are told of it.
#pragma once

#include "protocol/wire/sections/materials.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::wire {

struct EditableMaterial {
    std::string id;                    // by which the section `materials` calls it
    std::string name;                  // in the scene's file, for people
    std::string curve;                 // that is edited, such as `distribution`
    std::string angle;                 // over which it runs, such as `half`
    std::vector<std::string> shapes;   // that the curve can be made of
    std::vector<std::string> presets;  // that the curve can take
    MaterialEdit baked;                // the material without an entry in the section

    friend bool operator==(const EditableMaterial&, const EditableMaterial&) = default;
};

[[nodiscard]] nlohmann::json to_json(const EditableMaterial& material);
// Unknown keys are ignored. Throws WireError at a pointer below `path`.
[[nodiscard]] EditableMaterial editable_material_from_json(const nlohmann::json& object,
                                                           const std::string& path);

}  // namespace relume::wire
