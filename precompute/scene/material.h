// What a surface is made of, before its textures are looked up at a point.
#pragma once

#include "precompute/scene/bsdf.h"
#include "precompute/scene/texture.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace relume::scene {

// Index into Scene::textures.
using TextureIndex = std::uint32_t;

// All materials are two-sided: the normal is turned to the viewer.
struct Material {
    std::string name{};
    BsdfModel model = BsdfModel::lambert;
    Imath::V3f base_colour{0.5F, 0.5F, 0.5F};  // Lambert albedo, Phong kd, GGX base colour
    Imath::V3f specular{0, 0, 0};              // Phong ks
    float exponent = 0;                        // Phong
    float metallic = 0;                        // GGX
    float roughness = 1;                       // GGX, perceptual
    float normal_scale = 1;
    float opacity = 1;                    // base alpha, used only with alpha_cutoff
    std::optional<float> alpha_cutoff{};  // glTF alphaMode MASK: holes where alpha < cutoff
    std::optional<TextureIndex> base_texture{};     // RGB × base_colour; alpha × opacity
    std::optional<TextureIndex> surface_texture{};  // glTF: roughness × G, metallic × B
    std::optional<TextureIndex> normal_texture{};   // tangent space, +Y up

    // `vertex_colour` multiplies the base colour. Thread-safe.
    [[nodiscard]] Bsdf bsdf_at(std::span<const Texture> textures,
                               const Imath::V2f& uv,
                               const Imath::V3f& vertex_colour) const;
    // False where the surface has a hole (alpha below the cutoff). Rays must pass there.
    [[nodiscard]] bool is_solid_at(std::span<const Texture> textures,
                                   const Imath::V2f& uv) const;
    [[nodiscard]] bool has_holes() const { return alpha_cutoff.has_value(); }
};

}  // namespace relume::scene
