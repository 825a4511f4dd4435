// What a bake is asked to store beside light: what points of the scene see of the light.
#pragma once

#include "precompute/bake/base/parameters.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relume::bake {

struct FieldRequest {
    // Of pixels: materials that people are to edit under any light, by name.
    std::vector<std::string> editable{};
    // Of a surface: what all its vertices see.
    bool of_vertices = false;
    // Of the cubemap that points see, n; none: that of the light.
    std::optional<std::uint32_t> resolution{};

    [[nodiscard]] bool empty() const { return editable.empty() && !of_vertices; }
    [[nodiscard]] std::uint32_t resolution_of(const BakeParameters& parameters) const {
        return resolution.value_or(parameters.face_resolution);
    }
};

// Throws program::UsageError where the request is for receivers of another kind than those of
// the parameters, for too many materials, for one twice, or for a resolution that is none, or
// of an image finer than the light's. The parameters have been checked.
void check_fields(const FieldRequest& request, const BakeParameters& parameters);

}  // namespace relume::bake
