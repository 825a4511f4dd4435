#include "precompute/scene/material.h"

namespace relume::scene {
namespace {

Imath::V3f rgb(const Imath::V4f& value) {
    return {value.x, value.y, value.z};
}

}  // namespace

Bsdf Material::bsdf_at(std::span<const Texture> textures,
                       const Imath::V2f& uv,
                       const Imath::V3f& vertex_colour) const {
    Imath::V3f base = base_colour * vertex_colour;
    if (base_texture)
        base *= rgb(textures[*base_texture].evaluate(uv));
    switch (model) {
        case BsdfModel::lambert:
            return Bsdf::lambert(base);
        case BsdfModel::phong:
            return Bsdf::phong(base, specular, exponent);
        case BsdfModel::ggx:
            break;
    }
    float metal = metallic;
    float rough = roughness;
    if (surface_texture) {
        const Imath::V4f surface = textures[*surface_texture].evaluate(uv);
        rough *= surface.y;
        metal *= surface.z;
    }
    return Bsdf::ggx(base, metal, rough);
}

bool Material::is_solid_at(std::span<const Texture> textures, const Imath::V2f& uv) const {
    if (!alpha_cutoff)
        return true;
    const float alpha = base_texture ? textures[*base_texture].evaluate(uv).w : 1.0F;
    return alpha * opacity >= *alpha_cutoff;
}

}  // namespace relume::scene
