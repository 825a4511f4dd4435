// How far the picture of a bake is from a reference, kind of pixel by kind of pixel.
#pragma once

#include "tests/lab/measures/bake_reference.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace relume::lab {

// Each pixel that sees the scene is of one kind under one light, the first that holds:
//
// - edge: surfaces meet in it, or one and the sky;
// - penumbra: it sees between 2 % and 98 % of the light's brightest texels;
// - gloss: its surface reflects sharply (GGX roughness of 0.5 at most, exponents from 30);
// - matte: all others, where the noise is that of indirect light.
enum NoiseKind : std::uint8_t { kEdge, kPenumbra, kGloss, kMatte, kNoiseKinds };
inline constexpr std::array<std::string_view, kNoiseKinds> kNoiseKindNames{"edge", "penumbra",
                                                                           "gloss", "matte"};

// Sums of a kind over pixels and bakes.
struct KindNoise {
    // Σ (B − R₁)·(B − R₂) and Σ R₁·R₂ of the reference's halves R: what they are off by
    // themselves is in neither's expectation.
    double squared_error = 0;
    double energy = 0;
    std::vector<double> delta_e;  // by pixel, of what is shown

    // √(squared_error / energy); 0 where the reference is black.
    [[nodiscard]] double relative_rmse() const;
    [[nodiscard]] double mean_delta_e() const;
    // Below it lies the share `part` of the pixels; 0 where there are none.
    [[nodiscard]] double delta_e_quantile(double part) const;
    void add(const KindNoise& other);
};

using BakeNoise = std::array<KindNoise, kNoiseKinds>;

// `picture` is a bake's, as LitReference has them.
[[nodiscard]] BakeNoise bake_noise(std::span<const float> picture,
                                   const BakeReference& reference,
                                   std::size_t light);

}  // namespace relume::lab
