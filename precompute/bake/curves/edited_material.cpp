#include "precompute/bake/curves/edited_material.h"

#include "precompute/bake/base/material_names.h"
#include "precompute/bake/curves/curve_model.h"
#include "precompute/bake/curves/point_brdf.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/material_ids.h"
#include "protocol/curve/curve_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace relume::bake {
namespace {

// MATERIAL or MATERIAL.CURVE; names of materials may hold dots.
struct Edit {
    std::uint32_t material = 0;
    std::string curve;
};

Edit edit_from_text(const scene::Scene& scene, const std::string& text) {
    if (const auto whole = find_material(scene, text)) {
        return {.material = *whole, .curve = {}};
    }
    const std::size_t dot = text.rfind('.');
    if (dot != std::string::npos) {
        if (const auto before = find_material(scene, text.substr(0, dot))) {
            return {.material = *before, .curve = text.substr(dot + 1)};
        }
    }
    throw program::UsageError(no_such_material("--edit " + text, text.substr(0, dot), scene));
}

std::size_t usual_curve(const curve::CurveBrdf& brdf) {
    for (const curve::CurveAngle angle :
         {curve::CurveAngle::half, curve::CurveAngle::reflection, curve::CurveAngle::along_u}) {
        if (const auto index = brdf.index_of(angle)) {
            return *index;
        }
    }
    return 0;
}

std::size_t curve_index(const curve::CurveBrdf& brdf,
                        const std::string& name,
                        const std::string& material) {
    if (name.empty()) {
        return usual_curve(brdf);
    }
    try {
        return brdf.index_of(name);
    } catch (const curve::CurveError& error) {
        throw program::UsageError(
            fmt::format("--edit {}.{}: {}", material, name, error.what()));
    }
}

}  // namespace

std::vector<EditedMaterial> edited_materials(const scene::Scene& scene,
                                             const CurveRequest& request,
                                             std::span<const MeasuredBrdf> measured) {
    StatedModels models(request, measured);
    std::vector<EditedMaterial> materials;
    text::MaterialIds ids;
    for (const std::string& text : request.edits) {
        const Edit edit = edit_from_text(scene, text);
        const scene::Material& material = scene.materials[edit.material];
        const bool is_listed = std::any_of(
            materials.begin(), materials.end(),
            [&](const EditedMaterial& other) { return other.material == edit.material; });
        if (is_listed) {
            throw program::UsageError(fmt::format(
                "--edit {}: the material is listed twice, expected one curve of each material",
                text));
        }
        if (materials.size() == transport::CurvesSection::kMostCurves) {
            throw program::UsageError(
                fmt::format("--edit has {} materials, expected at most {}",
                            request.edits.size(), transport::CurvesSection::kMostCurves));
        }
        StatedModel stated = models.take(material);
        const std::size_t index = curve_index(stated.brdf, edit.curve, material.name);
        materials.push_back({.material = edit.material,
                             .name = material.name,
                             .id = ids.next(material.name),
                             .brdf = std::move(stated.brdf),
                             .curve = index,
                             .is_of_scene = stated.is_of_scene,
                             .albedo = stated.albedo,
                             .notes = std::move(stated.notes)});
        const std::string left_out = left_out_by_curve(material, materials.back());
        if (!left_out.empty()) {
            materials.back().notes["texture_left_out"] = left_out;
        }
    }
    models.require_all_taken();
    return materials;
}

transport::CurveRecord record_of(const EditedMaterial& material) {
    const curve::BrdfCurve& curve = material.brdf.curves()[material.curve];
    return {.id = material.id,
            .name = material.name,
            .curve = std::string(curve.name()),
            .angle = std::string(curve::kCurveAngleNames.name(curve.angle)),
            .brdf = curve::json_from_curve_brdf(material.brdf),
            .baked = curve.curve.rgb};
}

}  // namespace relume::bake
