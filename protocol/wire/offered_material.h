// A material that a server offers for parts of scenes, as /api/materials has it.
#pragma once

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::wire {

// One material; or a family of them, which differ in one number and are mixed in between.
struct OfferedMaterial {
    std::string name;
    std::uint32_t face_resolution = 0;  // of the scenes whose parts can be given it
    std::vector<Imath::V3d> colours;    // of its lobes, 1 to 4
    std::optional<std::string> parameter = std::nullopt;  // of a family: what its number is
    std::vector<double> steps = {};  // of a family, ascending: the numbers it has tables of

    friend bool operator==(const OfferedMaterial&, const OfferedMaterial&) = default;
};

[[nodiscard]] nlohmann::json to_json(const OfferedMaterial& material);
// Unknown keys are ignored. Throws WireError at a pointer below `path`.
[[nodiscard]] OfferedMaterial offered_material_from_json(const nlohmann::json& object,
                                                         const std::string& path);

}  // namespace relume::wire
