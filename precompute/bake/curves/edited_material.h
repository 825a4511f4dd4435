// A material of the scene of which people edit one curve of its BRDF, and its diffuse colour.
#pragma once

#include "precompute/bake/base/measured_brdf.h"
#include "precompute/factors/curve_factors.h"
#include "precompute/scene/scene.h"
#include "protocol/curve/curve_brdf.h"
#include "protocol/transport/curves_section.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace relume::bake {

struct EditedMaterial {
    std::uint32_t material = 0;  // index into the scene's materials
    std::string name;            // in the scene
    std::string id;              // by which rooms call it
    curve::CurveBrdf brdf;       // its specular part
    std::size_t curve = 0;       // which of the BRDF's curves
    // The BRDF is the scene's, whose textures change it from point to point (point_brdf.h).
    bool is_of_scene = false;
    // Of a measured one: the albedo of its diffuse part, in place of the scene's.
    std::optional<Imath::V3f> albedo{};
    nlohmann::json notes = nlohmann::json::object();  // what measured BRDFs and textures lose

    [[nodiscard]] curve::CurveAngle angle() const { return brdf.curves()[curve].angle; }
};

// What a person asks for, in words.
struct CurveRequest {
    std::vector<std::string> edits{};   // MATERIAL or MATERIAL.CURVE
    std::vector<std::string> models{};  // MATERIAL=MODEL:parameter=value,…; a colour is r/g/b
    // How measured BRDFs become curves.
    factors::CurveMethod factors = factors::CurveMethod::homomorphic;
};

// In the order of the request; measured BRDFs are factored. Throws program::UsageError for a
// material or a curve that is not there, naming those that are near, for one listed twice, for
// more than 16, for a model that does not exist, a parameter out of range, or a model of a
// material that is not edited; factors::FactorError for a measured BRDF that has no such
// factors.
[[nodiscard]] std::vector<EditedMaterial> edited_materials(
    const scene::Scene& scene,
    const CurveRequest& request,
    std::span<const MeasuredBrdf> measured = {});

// The material where its textures, and colours of vertices, are white.
[[nodiscard]] scene::Bsdf bsdf_without_textures(const scene::Material& material);

// The BRDF's specular part as curves: of GGX and Phong exactly as the scene has them where
// textures and colours of vertices are white. Throws program::UsageError for Lambert, which has
// none.
[[nodiscard]] curve::CurveBrdf curve_brdf_of(const scene::Material& material);

// As a manifest has it.
[[nodiscard]] transport::CurveRecord record_of(const EditedMaterial& material);

}  // namespace relume::bake
