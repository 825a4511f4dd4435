// An isotropic BRDF as lobes: functions of the direction to the light ωi and the direction to
// the viewer ωo in the local frame, z along the normal, that are multiplied by colours and
// added:
//
//     ρ(ωi, ωo)[rgb] = Σ_l colour_l[rgb]·lobe_l(ωi, ωo)    in 1/sr.
//
// Colours vary over a surface, with its textures, and lobes do not.
//
// - Lambert: {diffuse}.
// - Phong: {diffuse, specular}.
// - GGX: {diffuse, F0, F90}, for Schlick's F = F0·(1 − s) + F90·s is linear in both.
// - A measured BRDF: {red, green, blue}.
#pragma once

#include "precompute/scene/bsdf.h"
#include "protocol/brdf/directions.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace relume::factors {

class MerlBrdf;

struct BrdfLobes {
    // out[l·n + i] is lobe l from the i-th of n directions wi to wo. Both lie above the
    // horizon. A lobe is finite, and depends on φo − φi alone, evenly. Thread-safe.
    using Evaluate = std::function<void(
        const Imath::V3f& wo, const brdf::Directions& wi, std::span<float> out)>;

    std::vector<Imath::V3f> mean_colours;  // one a lobe, not negative
    double width_rad = 1;  // of the narrowest highlight: its value falls to about half there
    Evaluate evaluate;

    [[nodiscard]] std::size_t count() const { return mean_colours.size(); }
    // Weight of a lobe where all count alike: the root mean square of its colour's three
    // values; 1 for every lobe where all are black.
    [[nodiscard]] std::vector<double> weights() const;
};

// The colours of a point's lobes, in the order above.
[[nodiscard]] std::vector<Imath::V3f> lobe_colours(const scene::Bsdf& bsdf);
// The lobes of a surface whose points have the shape of `mean` and its colours on average
// (Bsdf::with_mean_colours).
[[nodiscard]] BrdfLobes lobes_of(const scene::Bsdf& mean);
// Shares the table with `measured`.
[[nodiscard]] BrdfLobes lobes_of(const MerlBrdf& measured);

}  // namespace relume::factors
