#include "precompute/scene/material.h"

#include <algorithm>

namespace relume::scene {
namespace {

Imath::V3f rgb(const Imath::V4f& value) {
    return {value.x, value.y, value.z};
}

}  // namespace

Bsdf Material::bsdf_at(std::span<const Texture> textures,
                       const PointUvs& uvs,
                       const Imath::V3f& vertex_colour) const {
    const auto texel = [&](const TextureUse& use) {
        return textures[use.texture].evaluate(uvs.of_set[use.uv_set]);
    };
    Imath::V3f base = base_colour * vertex_colour;
    if (base_texture)
        base *= rgb(texel(*base_texture));
    switch (model) {
        case BsdfModel::lambert:
            return Bsdf::lambert(base);
        case BsdfModel::phong:
            return Bsdf::phong(
                base, specular_texture ? specular * rgb(texel(*specular_texture)) : specular,
                exponent_texture ? exponent * texel(*exponent_texture).x : exponent);
        case BsdfModel::ggx:
            break;
    }
    float metal = metallic;
    float rough = roughness;
    if (surface_texture) {
        const Imath::V4f surface = texel(*surface_texture);
        rough *= surface.y;
        metal *= surface.z;
    }
    if (gloss_texture)
        rough = 1.0F - (1.0F - rough) * texel(*gloss_texture).w;
    Dielectric dielectric{.f0 = dielectric_f0, .f90 = dielectric_f90};
    if (dielectric_texture)
        dielectric.f90 *= texel(*dielectric_texture).w;
    if (dielectric_colour_texture)
        dielectric.f0 *= rgb(texel(*dielectric_colour_texture));
    for (int c = 0; c < 3; ++c)
        dielectric.f0[c] = std::min(dielectric.f0[c], 1.0F) * dielectric.f90;
    return Bsdf::ggx(base, metal, rough, dielectric);
}

bool Material::is_solid_at(std::span<const Texture> textures,
                           const PointUvs& uvs,
                           float vertex_opacity) const {
    if (!alpha_cutoff)
        return true;
    float alpha = opacity * vertex_opacity;
    if (base_texture)
        alpha *= textures[base_texture->texture].evaluate(uvs.of_set[base_texture->uv_set]).w;
    return alpha >= *alpha_cutoff;
}

}  // namespace relume::scene
