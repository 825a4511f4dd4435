// What a scene is and what may be edited in its rooms: `/api/scenes` and the snapshot say it.
#pragma once

#include "protocol/wire/editable_material.h"
#include "protocol/wire/scene_part.h"
#include "protocol/wire/sections/camera.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::wire {

// A sphere around all that a scene shows, in the world.
struct SceneBounds {
    Imath::V3d centre{0, 0, 0};
    double radius = 0;

    friend bool operator==(const SceneBounds&, const SceneBounds&) = default;
};

struct SceneSummary {
    std::string name;
    std::string kind = "image";  // of the transport, as its manifest names it
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::string basis = "haar";  // of the light, as the manifest names it
    std::optional<std::uint32_t> order = std::nullopt;  // of spherical harmonics
    std::uint32_t face_resolution = 0;
    std::uint32_t columns = 0;
    std::uint32_t channels = 0;      // stored, 1 or 3
    std::uint64_t bytes = 0;         // of the transport directory's checked files
    std::uint64_t memory_bytes = 0;  // that the server holds for it
    std::optional<double> bake_error =
        std::nullopt;                             // relative L2 that the bake's sampling leaves
    std::optional<Camera> camera = std::nullopt;  // where its rooms begin
    std::optional<SceneBounds> bounds = std::nullopt;  // where the camera can move
    std::vector<EditableMaterial> materials = {};      // of kind `curves`
    // Of a scene whose vertices know what they see of the light: the n of what they see, and the
    // parts that may be given materials of that n.
    std::optional<std::uint32_t> visibility_resolution = std::nullopt;
    std::vector<ScenePart> parts = {};
    std::vector<std::string> edits = {};               // the sections of state that take edits

    friend bool operator==(const SceneSummary&, const SceneSummary&) = default;
};

[[nodiscard]] nlohmann::json to_json(const SceneSummary& scene);
// Of a server that may say more, or, being older, less: name, width, height and face_resolution
// must be there. Throws WireError at a pointer below `path`.
[[nodiscard]] SceneSummary scene_summary_from_json(const nlohmann::json& object,
                                                   const std::string& path);

}  // namespace relume::wire
