// Curves by the name of a material.
//
// - `gold`, `silver`, `copper` over `difference`: conductors with the indices measured at
//   616.8, 548.6 and 450.9 nm in place of red, green and blue [JohnsonChristy72];
// - `aluminium` likewise, its indices linear between the measured ones [Hagemann75];
// - `pearl`, `satin`, `velvet` over `half`: distributions of normals, sums of shapes whose
//   weights add to one, so that they are normalised as those are. A pearl is a sharp reflection
//   and a hazy one.
//
// Thread-safe.
#pragma once

#include "protocol/curve/curve_shape.h"

#include <span>
#include <string_view>
#include <vector>

namespace relume::curve {

struct PresetPart {
    double weight = 1;
    ShapedCurve shape;
};

struct CurvePreset {
    std::string_view name;
    CurveAngle angle = CurveAngle::half;  // what it is made for
    std::vector<PresetPart> parts;

    [[nodiscard]] Curve curve() const;
};

[[nodiscard]] std::span<const CurvePreset> curve_presets();
// Throws CurveError that names the presets that are near.
[[nodiscard]] const CurvePreset& preset_from_name(std::string_view name);

}  // namespace relume::curve
