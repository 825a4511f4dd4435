// Images by K terms of every material against the scene's own BRDFs.
#include "tests/lab/geometry/view_terms.h"

#include "precompute/scene/builtin.h"
#include "tests/lab/sequences/map_cubemap.h"

#include <gtest/gtest.h>

namespace relume::lab {
namespace {

std::vector<ViewTerms> found_in(const scene::Scene& scene) {
    const std::vector<bake::CubemapLight> lights{cubemap_of_map("sky-overcast", 8),
                                                 cubemap_of_map("bare-sun", 8)};
    return measure_view_terms(scene, lights,
                              {.views = 2, .side = 8, .face_resolution = 8, .most_terms = 6});
}

TEST(ViewTerms, OfDiffuseMaterialsOneTermIsAllOfIt) {
    for (const ViewTerms& found : found_in(scene::build_builtin_scene("box"))) {
        EXPECT_GT(found.points, 60U);
        for (const double error : found.errors) {
            EXPECT_LT(error, 1e-4);
        }
    }
}

TEST(ViewTerms, OfGlossyMaterialsMoreTermsLeaveLess) {
    scene::Scene scene = scene::build_builtin_scene("box");
    for (scene::Material& material : scene.materials) {
        material = {.name = material.name,
                    .model = scene::BsdfModel::phong,
                    .base_colour = {0.2F, 0.3F, 0.1F},
                    .specular = {0.5F, 0.5F, 0.5F},
                    .exponent = 20};
    }
    for (const ViewTerms& found : found_in(scene)) {
        EXPECT_GT(found.errors[0], 0.01);
        EXPECT_LT(found.errors[5], 0.8 * found.errors[0]);
        for (std::size_t k = 0; k < found.errors.size(); ++k) {
            EXPECT_GE(found.worst[k], found.errors[k] * 0.999);
        }
    }
}

}  // namespace
}  // namespace relume::lab
