// Edits of materials as people make them, spelled out as samples of curves.
#pragma once

#include "protocol/transport/curves_section.h"
#include "protocol/wire/sections/materials.h"

#include <nlohmann/json.hpp>

#include <span>

namespace relume::net {

// A patch of a room's state whose materials have samples wherever it says how to make them: by
// control points, by a shape and its parameters, by a preset's name, by a stroke over the curve
// as it is, and for a material that has no entry yet from the curve as baked. All other parts
// stay as they are. Throws wire::WireError naming what cannot be, as wire::apply_patch does,
// and {unknown_name} for a material that the scene does not have.
[[nodiscard]] nlohmann::json with_samples(const nlohmann::json& patch,
                                          const wire::MaterialEdits& edits,
                                          std::span<const transport::CurveRecord> curves);

}  // namespace relume::net
