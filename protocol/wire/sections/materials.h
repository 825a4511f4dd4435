// Editable materials of a scene whose kind is `curves`, by the name that the scene gives them:
// each has one curve of its BRDF that people edit, and a diffuse colour.
#pragma once

#include "protocol/curve/control_points.h"
#include "protocol/curve/curve_shape.h"
#include "protocol/wire/sections/section.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace relume::wire {

// The curve shown is `samples` times `tint`. Where the samples were made from control points or
// a shape, these stand beside them, so that whoever edits on begins with them. A material
// without an entry is as it was baked.
struct MaterialEdit {
    NumberTable samples{.columns = 3, .numbers = {}};  // [256][r, g, b]
    std::optional<NumberTable> points;                 // [1 … 32][u, r, g, b]
    curve::ValueScale scale = curve::ValueScale::linear;
    std::optional<curve::CurveShape> shape;
    double roughness = 0.2;
    double exponent = 50;
    Imath::V3d n{1.5, 1.5, 1.5};
    Imath::V3d e{0, 0, 0};
    Imath::V3d f0{0.04, 0.04, 0.04};
    double f90 = 1;
    Imath::V3d value{1, 1, 1};
    Imath::V3d tint{1, 1, 1};
    Imath::V3d diffuse{1, 1, 1};

    friend bool operator==(const MaterialEdit&, const MaterialEdit&) = default;
};

using MaterialEdits = std::map<std::string, MaterialEdit>;

[[nodiscard]] inline MaterialEdit fresh_material_edit(const MaterialEdits& /*others*/) {
    return {};
}

// Of a value of a curve. The distribution of a mirror is narrow and high.
inline constexpr Range kCurveValue{0, curve::kMostCurveValue};

inline constexpr std::array kMaterialFields{
    field::table<&MaterialEdit::samples>("samples",
                                         {curve::kCurveSamples, curve::kCurveSamples, 3},
                                         kCurveValue,
                                         "of the curve, r, g, b at u = k/255")
        .needed(),
    field::table<&MaterialEdit::points>(
        "points",
        {1, curve::kMostControlPoints, 4},
        kCurveValue,
        "u, r, g, b of the control points that the samples were made from"),
    field::word<&MaterialEdit::scale, curve::kValueScaleNames>(
        "scale", "of the values between control points"),
    field::word<&MaterialEdit::shape, curve::kCurveShapeNames>(
        "shape", "that the samples were made from, with the parameters below"),
    field::number<&MaterialEdit::roughness>(
        "roughness", {0.001, 2}, "σ of shapes `beckmann` and `velvet`, α of `ggx`"),
    field::number<&MaterialEdit::exponent>("exponent", {0, 1e5}, "of shape `cosine_power`"),
    field::triple<&MaterialEdit::n>(
        "n", {0.01, 10}, "index of refraction, of `conductor`; its green that of `dielectric`"),
    field::triple<&MaterialEdit::e>("e", {0, 20}, "extinction, of shape `conductor`"),
    field::triple<&MaterialEdit::f0>("f0", {0, 1}, "reflected straight on, of shape `schlick`"),
    field::number<&MaterialEdit::f90>(
        "f90", {0, 1}, "reflected at grazing angles, of shape `schlick`"),
    field::triple<&MaterialEdit::value>("value", kCurveValue, "of shape `constant`"),
    field::triple<&MaterialEdit::tint>("tint", kColour, "times the curve, by colour"),
    field::triple<&MaterialEdit::diffuse>(
        "diffuse", kColour, "times the diffuse reflection as baked, by colour"),
};

inline constexpr KeyedSection<MaterialEdit> kMaterials{
    {"materials", Stage::signal, "Edited materials, by their names in the scene",
     kMaterialFields},
    "material edit",
    "materials",
    fresh_material_edit,
    &Limits::materials_per_room};

}  // namespace relume::wire
