// Reflection at one point: a material whose textures have been looked up. Three models, chosen
// by the material: Lambert, normalised Phong, GGX metallic-roughness.
//
// Contract [after Mitsuba's BSDF]: directions are unit, point away from the surface, and are
// given in the shading frame, z along the normal; both `wi` (to the light) and `wo` (to the
// viewer) must have z > 0, else the value is zero. `evaluate` is f in 1/sr, *without* the
// cosine. f(wi, wo) = f(wo, wi), f ≥ 0, and ∫ f cos θi dωi ≤ 1 per channel. All const members
// are thread-safe.
//
// - Lambert: colour/π.
// - Phong: kd/π + ks (e+2)/(2π) max(0, cos α)^e, α between wi and the mirrored wo
//   [Lafortune94]; kd and ks scaled down together where a channel of their sum exceeds 1.
// - GGX: F0 = lerp(f0, base, metallic), F90 = lerp(f90, 1, metallic) with f0 and f90 of the
//   dielectric (0.04 and 1 where nothing says otherwise), α = roughness²; Schlick F, Smith's
//   height-correlated G [Heitz14], plus the coupled diffuse layer
//   (1−metallic)·base·(1−F(cos θi))(1−F(cos θo)) / (π (1−F̄)) with F of a dielectric of the
//   largest channel of f0 [Shirley97]; glTF's own layer, 1−F(h), makes energy at grazing
//   angles.
#pragma once

#include "precompute/scene/bsdf_lobes.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::scene {

enum class BsdfModel : std::uint8_t { lambert, phong, ggx };

struct BsdfSample {
    Imath::V3f wi{0, 0, 0};      // shading frame
    Imath::V3f weight{0, 0, 0};  // f cos θi / pdf; zero: the path ends here
    float pdf = 0;               // per steradian, over all lobes
};

// What a dielectric reflects straight on and at grazing angles.
struct Dielectric {
    Imath::V3f f0{0.04F, 0.04F, 0.04F};
    float f90 = 1;
};

// Planes of equal length.
struct Directions {
    std::span<const float> x, y, z;
};
struct RgbPlanes {
    std::span<float> r, g, b;
};

// What the colours of a model are multiplied onto; planes of equal length.
struct LobePlanes {
    std::span<float> diffuse;   // × Bsdf::diffuse_colour()
    std::span<float> specular;  // × Bsdf::specular_colour()
    std::span<float> grazing;   // × Bsdf::grazing()
};

class Bsdf {
  public:
    // Colours are clamped to [0, 1].
    [[nodiscard]] static Bsdf lambert(const Imath::V3f& albedo);
    // `exponent` is clamped to [0, 1e5].
    [[nodiscard]] static Bsdf phong(const Imath::V3f& diffuse,
                                    const Imath::V3f& specular,
                                    float exponent);
    // `roughness` is glTF's perceptual one, clamped to [kMinRoughness, 1]; `metallic` to [0,
    // 1]; the dielectric's f90 to [0, 1] and its f0 to [0, f90].
    [[nodiscard]] static Bsdf ggx(const Imath::V3f& base,
                                  float metallic,
                                  float roughness,
                                  const Dielectric& dielectric = {});
    // Below this a highlight is narrower than anything a cubemap texel resolves.
    static constexpr float kMinRoughness = 0.05F;

    // The mean of several places of one surface: lobes as here, and colours that the places
    // have on average. As f is linear in its colours, this is their mean f where they differ in
    // nothing else.
    [[nodiscard]] Bsdf with_mean_colours(std::span<const Bsdf> places) const;

    [[nodiscard]] BsdfModel model() const { return model_; }
    // f is the constant diffuse_colour()/π.
    [[nodiscard]] bool is_diffuse() const { return model_ == BsdfModel::lambert; }
    // Lambert: the albedo. Phong: kd as scaled. GGX: (1−metallic)·base.
    [[nodiscard]] const Imath::V3f& diffuse_colour() const { return diffuse_; }
    // Lambert: zero. Phong: ks as scaled. GGX: F0.
    [[nodiscard]] const Imath::V3f& specular_colour() const { return specular_; }
    // Phong only.
    [[nodiscard]] float exponent() const { return exponent_; }
    // GGX only: α = roughness².
    [[nodiscard]] float alpha() const { return alpha_; }
    // GGX only: F90.
    [[nodiscard]] float grazing() const { return grazing_; }
    // GGX only: the dielectric over the diffuse layer.
    [[nodiscard]] const lobes::Coat& coat() const { return coat_; }

    [[nodiscard]] Imath::V3f evaluate(const Imath::V3f& wi, const Imath::V3f& wo) const;
    // out = f(wi, wo)·cos θi for many wi at once; out is zero where wi.z ≤ 0.
    void evaluate_times_cosine(const Imath::V3f& wo,
                               const Directions& wi,
                               const RgbPlanes& out) const;
    // The same with the colours taken out: f·cos θi is the sum of colour × plane, to rounding.
    // Lambert leaves the last two at zero, Phong the last.
    void evaluate_lobes_times_cosine(const Imath::V3f& wo,
                                     const Directions& wi,
                                     const LobePlanes& out) const;
    // `u_lobe` in [0, 1) chooses the lobe, `u` in [0, 1)² the direction in it.
    [[nodiscard]] BsdfSample sample(const Imath::V3f& wo,
                                    float u_lobe,
                                    const Imath::V2f& u) const;
    // Density with which `sample` returns wi.
    [[nodiscard]] float pdf(const Imath::V3f& wi, const Imath::V3f& wo) const;

  private:
    Bsdf() = default;
    // Chance that `sample` takes the diffuse lobe, seen from wo.
    [[nodiscard]] float diffuse_chance(const Imath::V3f& wo) const;

    BsdfModel model_ = BsdfModel::lambert;
    Imath::V3f diffuse_{0, 0, 0};
    Imath::V3f specular_{0, 0, 0};
    float exponent_ = 0;
    float alpha_ = 1;
    float grazing_ = 1;  // GGX: F90
    lobes::Coat coat_;   // GGX: over the diffuse layer
};

}  // namespace relume::scene
