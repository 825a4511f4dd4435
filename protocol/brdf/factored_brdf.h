// A BRDF as a short sum of products, each of a function of the direction to the light and a
// function of the direction to the viewer [Wang04, Liu04]:
//
//     ρ(ωi, ωo)[rgb] = Σ_l colour_l[rgb] · Σ_k h_{k,l}(ωo) · g_k(ωi)    in 1/sr.
//
// k counts *terms*. l counts *lobes*, the parts of a BRDF that have a colour of their own: the
// diffuse and the specular part, or red, green and blue of a measured BRDF. Colours stand
// elsewhere, with the textures. Directions are of the local frame (local_frame.h).
//
// Terms are scaled so that errors in the light reflected by each of them weigh alike in an
// image: Σ_l w_l²·mean of h_{k,l}² is 1 for every k that is not 0, with w_l the root mean
// square over red, green and blue of the lobe's mean colour (1 for all lobes of a black
// material) and the mean over the hemisphere weighted by cos θo. A reader relies on nothing of
// it.
#pragma once

#include "protocol/brdf/direction_table.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace relume::brdf {

struct FactoredBrdf {
    static constexpr std::uint32_t kMostTerms = 16;
    static constexpr std::uint32_t kMostLobes = 4;
    static constexpr std::size_t kMostNameBytes = 255;

    std::string name;
    std::uint32_t terms = 1;  // K
    std::uint32_t lobes = 1;  // L
    DirectionTable g;         // of depth K: value k is g_k(ωi)
    DirectionTable h;         // of depth K·L: value k·L + l is h_{k,l}(ωo)

    // Σ_l colours[l] Σ_k h_{k,l}(wo) g_k(wi), both in the local frame; L colours. 0 where one
    // of the directions is not above the horizon. Thread-safe.
    [[nodiscard]] Imath::V3f evaluate(const Imath::V3f& wi,
                                      const Imath::V3f& wo,
                                      std::span<const Imath::V3f> colours) const;
};

// Throws BrdfError, naming the BRDF, for counts out of range, tables of another depth, or a
// name that is too long or has a control character.
void require_valid(const FactoredBrdf& brdf);

// Lambert's BRDF, exactly: one term, one lobe, g = s/π and h = 1/s with s the root mean square
// of red, green and blue of the mean albedo, or 1 where that is black.
[[nodiscard]] FactoredBrdf factored_lambert(std::string name, const Imath::V3f& mean_albedo);

}  // namespace relume::brdf
