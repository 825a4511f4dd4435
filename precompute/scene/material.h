// What a surface is made of, before its textures are looked up at a point.
#pragma once

#include "precompute/scene/bsdf.h"
#include "precompute/scene/texture.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace relume::scene {

// Index into Scene::textures.
using TextureIndex = std::uint32_t;

// A texture as a material looks it up: by one of the mesh's sets of texture coordinates. What a
// file says of transforms is in the coordinates already.
struct TextureUse {
    TextureIndex texture = 0;
    std::uint32_t uv_set = 0;  // < kMaxUvSets

    TextureUse(TextureIndex of, std::uint32_t set = 0) : texture(of), uv_set(set) {}
    [[nodiscard]] bool operator==(const TextureUse&) const = default;
};

inline constexpr std::size_t kMaxUvSets = 8;

// Texture coordinates at one point, set by set; (0, 0) where the mesh has none.
struct PointUvs {
    std::array<Imath::V2f, kMaxUvSets> of_set{};

    PointUvs() { of_set.fill(Imath::V2f(0, 0)); }
    PointUvs(const Imath::V2f& first) : PointUvs() { of_set[0] = first; }
};

// All materials are two-sided: the normal is turned to the viewer.
struct Material {
    std::string name{};
    BsdfModel model = BsdfModel::lambert;
    Imath::V3f base_colour{0.5F, 0.5F, 0.5F};  // Lambert albedo, Phong kd, GGX base colour
    Imath::V3f specular{0, 0, 0};              // Phong ks
    float exponent = 0;                        // Phong
    float metallic = 0;                        // GGX
    float roughness = 1;                       // GGX, perceptual
    // GGX: the dielectric below the metal reflects min(dielectric_f0, 1)·dielectric_f90
    // straight on and dielectric_f90 at grazing angles (KHR_materials_specular).
    Imath::V3f dielectric_f0{0.04F, 0.04F, 0.04F};
    float dielectric_f90 = 1;
    float normal_scale = 1;
    float opacity = 1;                    // base alpha, used only with alpha_cutoff
    std::optional<float> alpha_cutoff{};  // glTF alphaMode MASK: holes where alpha < cutoff
    std::optional<TextureUse> base_texture{};        // RGB × base_colour; alpha × opacity
    std::optional<TextureUse> specular_texture{};    // Phong: specular × RGB
    std::optional<TextureUse> exponent_texture{};    // Phong: exponent × R
    std::optional<TextureUse> surface_texture{};     // glTF: roughness × G, metallic × B
    std::optional<TextureUse> gloss_texture{};       // glossiness, 1 − roughness, × alpha
    std::optional<TextureUse> dielectric_texture{};  // dielectric_f90 × alpha
    std::optional<TextureUse> dielectric_colour_texture{};  // dielectric_f0 × RGB
    std::optional<TextureUse> normal_texture{};             // tangent space, +Y up

    // `vertex_colour` multiplies the base colour. Thread-safe.
    [[nodiscard]] Bsdf bsdf_at(std::span<const Texture> textures,
                               const PointUvs& uvs,
                               const Imath::V3f& vertex_colour) const;
    // False where the surface has a hole (alpha below the cutoff). Rays must pass there.
    // `vertex_opacity` multiplies the alpha.
    [[nodiscard]] bool is_solid_at(std::span<const Texture> textures,
                                   const PointUvs& uvs,
                                   float vertex_opacity) const;
    [[nodiscard]] bool has_holes() const { return alpha_cutoff.has_value(); }
};

}  // namespace relume::scene
