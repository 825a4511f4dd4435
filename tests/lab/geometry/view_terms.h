// What K terms of every material leave of an image, against the scene's own BRDFs.
#pragma once

#include "precompute/bake/relight.h"
#include "precompute/scene/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::lab {

struct ViewTermsOptions {
    std::uint32_t views = 8;             // spread evenly around what the camera looks at
    std::uint32_t side = 48;             // points across an image
    std::uint32_t face_resolution = 32;  // of the lights
    std::uint32_t most_terms = 10;
};

// Under one light.
struct ViewTerms {
    std::vector<double> errors;  // [K − 1], relative L2 over all views
    std::vector<double> worst;   // [K − 1], of the view in which it is largest
    std::size_t points = 0;      // that see the scene, in all views
};

// Materials are factored as relume-bake factors them for natural light. Every pixel looks at
// one point, which is lit straight by each of `lights`: once by the scene's BSDF there, and
// once by the sums of the first K terms. Both see the light by the same rays, so that the BRDF
// is all that they differ in. One ViewTerms a light. Parallel; depends on nothing but its
// arguments. Throws as mesh_materials.
[[nodiscard]] std::vector<ViewTerms> measure_view_terms(
    const scene::Scene& scene,
    std::span<const bake::CubemapLight> lights,
    const ViewTermsOptions& options);

}  // namespace relume::lab
