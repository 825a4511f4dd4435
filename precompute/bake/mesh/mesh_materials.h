// A scene's materials as a mesh transport holds them: factored BRDFs, and colours and textures
// of their lobes.
#pragma once

#include "precompute/bake/base/measured_brdf.h"
#include "precompute/factors/factorise.h"
#include "precompute/scene/scene.h"
#include "protocol/transport/mesh_section.h"
#include "protocol/transport/surface_textures.h"

#include <span>
#include <string>
#include <vector>

namespace relume::bake {

// By the number of the scene's material: its BRDF has its number too.
struct MeshMaterials {
    std::vector<factors::Factorisation> factored;
    std::vector<transport::MaterialRecord> records;
    std::vector<transport::SurfaceTexture> textures;
    // What of the materials is not shown: detail of roughness, normal maps, opacities of
    // vertices.
    std::vector<std::string> notes;

    [[nodiscard]] std::vector<brdf::FactoredBrdf> brdfs() const;
};

// What textures say of a material's colours is looked up at every texel and stored as colours
// of lobes: a metal's base colour is no diffuse colour. Lobes have one shape over a material,
// that of its median roughness or exponent. A measured BRDF takes the place of all that the
// scene says of its material's reflection. Deterministic. Throws BakeError,
// factors::FactorError.
[[nodiscard]] MeshMaterials mesh_materials(const scene::Scene& scene,
                                           std::span<const MeasuredBrdf> measured,
                                           const factors::FactorOptions& options);

}  // namespace relume::bake
