// The materials of a scene of curves, in the words of the wire.
#pragma once

#include "protocol/curve/curve.h"
#include "protocol/curve/curve_angle.h"
#include "protocol/curve/curve_preset.h"
#include "protocol/transport/curves_section.h"
#include "protocol/wire/editable_material.h"

#include <Imath/ImathVec.h>
#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace relume::net {

// Numbers of six digits: short in JSON, and finer than any image shows.
[[nodiscard]] wire::NumberTable samples_from_curve(const curve::Curve& curve);
[[nodiscard]] curve::Curve curve_from_samples(const wire::NumberTable& samples);

// What an edit shows: its samples times its tint.
[[nodiscard]] curve::Curve edited_curve(const wire::MaterialEdit& edit);

// The material without an edit: the samples as baked, and what they were made from where that
// is a shape.
[[nodiscard]] wire::MaterialEdit edit_as_baked(const transport::CurveRecord& record);
// What clients are told.
[[nodiscard]] wire::EditableMaterial editable_material(const transport::CurveRecord& record);

// Values of the parameters of `edit.shape`, in the order of curve::parameters_of.
[[nodiscard]] std::vector<Imath::V3d> shape_values(const wire::MaterialEdit& edit);
// Presets that are made for an angle; what one of them sets of a material's fields.
[[nodiscard]] std::vector<std::string> presets_over(curve::CurveAngle angle);
[[nodiscard]] nlohmann::json patch_from_preset(const curve::CurvePreset& preset);

}  // namespace relume::net
