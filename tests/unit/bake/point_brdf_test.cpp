// An edited material at points where textures make it another.
#include "precompute/bake/curves/point_brdf.h"

#include "precompute/scene/scene.h"
#include "tests/unit/factors/directions.h"

#include <gtest/gtest.h>

#include <string>

namespace relume::bake {
namespace {

using Imath::V3f;

scene::Material metal() {
    return {.name = "m",
            .model = scene::BsdfModel::ggx,
            .base_colour = {0.9F, 0.8F, 0.6F},
            .metallic = 1,
            .roughness = 0.5F};
}

EditedMaterial edited(const scene::Material& material, const std::string& curve) {
    scene::Scene scene;
    scene.materials.push_back(material);
    return edited_materials(scene, {.edits = {"m." + curve}}).front();
}

scene::Bsdf at_white_texel(const scene::Material& material) {
    return material.bsdf_at({}, {}, V3f(1, 1, 1));
}

V3f without_curve(const EditedMaterial& material,
                  const scene::Bsdf& point,
                  const V3f& wi,
                  const V3f& wo) {
    const PointBrdf brdf(material, point);
    const sampling::CurveOfBrdf edited = brdf.edited();
    return edited.brdf.quotient(edited.curve, wi, wo) * edited.tint;
}

// f with the edited curve as baked, at a point.
V3f as_baked(const EditedMaterial& material,
             const scene::Bsdf& point,
             const V3f& wi,
             const V3f& wo) {
    const curve::BrdfCurve& curve = material.brdf.curves()[material.curve];
    return without_curve(material, point, wi, wo) *
           curve.curve.at(curve::u_from_directions(curve.angle, wi, wo));
}

void expect_as_the_scene(const scene::Material& material,
                         const std::string& curve,
                         const scene::Bsdf& point,
                         float most_off) {
    const EditedMaterial of_curve = edited(material, curve);
    factors::CosineDirections directions(4);
    for (int i = 0; i < 500; ++i) {
        const V3f wi = directions.next();
        const V3f wo = directions.next();
        V3f specular = point.evaluate(wi, wo);
        if (material.model == scene::BsdfModel::phong) {
            specular -= point.diffuse_colour() / static_cast<float>(M_PI);
        }
        const V3f found = as_baked(of_curve, point, wi, wo);
        EXPECT_NEAR((found - specular).length(), 0, most_off * specular.length() + 1e-5F)
            << curve;
    }
}

TEST(PointBrdf, ReflectsTheColourOfItsTexelWhereAnotherCurveIsEdited) {
    scene::Material red = metal();
    red.base_colour = {0.7F, 0.1F, 0.05F};
    expect_as_the_scene(metal(), "distribution", at_white_texel(red), 0.02F);
    expect_as_the_scene(metal(), "distribution", at_white_texel(metal()), 0.02F);
}

TEST(PointBrdf, HasTheRoughnessOfItsTexelWhereFresnelIsEdited) {
    scene::Material polished = metal();
    polished.roughness = 0.3F;
    expect_as_the_scene(metal(), "fresnel", at_white_texel(polished), 0.02F);
}

TEST(PointBrdf, ScalesTheCurveThatHoldsItsColour) {
    scene::Material red = metal();
    red.base_colour = {0.45F, 0.2F, 0.06F};
    const EditedMaterial of_fresnel = edited(metal(), "fresnel");
    const V3f wi = V3f(0.1F, 0.2F, 0.9F).normalized();
    const V3f wo = V3f(-0.3F, 0.1F, 0.8F).normalized();
    const V3f found = as_baked(of_fresnel, at_white_texel(red), wi, wo) /
                      as_baked(of_fresnel, at_white_texel(metal()), wi, wo);
    EXPECT_NEAR((found - V3f(0.5F, 0.25F, 0.1F)).length(), 0, 1e-4F);

    scene::Material varnish{.name = "m",
                            .model = scene::BsdfModel::phong,
                            .base_colour = {0.1F, 0.1F, 0.1F},
                            .specular = {0.8F, 0.8F, 0.8F},
                            .exponent = 20};
    scene::Material worn = varnish;
    worn.specular = {0.4F, 0, 0.2F};
    expect_as_the_scene(varnish, "lobe", at_white_texel(worn), 0.02F);
}

TEST(PointBrdf, ABrdfThatIsStatedHasNoTextures) {
    scene::Scene scene;
    scene.materials.push_back(metal());
    const EditedMaterial stated =
        edited_materials(scene, {.edits = {"m"}, .models = {"m=ggx:alpha=0.2"}}).front();
    scene::Material red = metal();
    red.base_colour = {0.7F, 0.1F, 0.05F};
    const V3f wi = V3f(0.1F, 0.2F, 0.9F).normalized();
    EXPECT_EQ(without_curve(stated, at_white_texel(red), wi, wi),
              stated.brdf.quotient(stated.curve, wi, wi));
}

TEST(PointBrdf, WhatOneCurveCannotHoldIsNamed) {
    scene::Material textured = metal();
    textured.surface_texture = 0;
    EXPECT_EQ(edited(textured, "distribution").notes.value("texture_left_out", ""),
              "roughness");
    EXPECT_TRUE(edited(textured, "fresnel").notes.empty());
    EXPECT_TRUE(edited(metal(), "distribution").notes.empty());
}

}  // namespace
}  // namespace relume::bake
