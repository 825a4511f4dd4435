// What a material field is made of: lobes as functions of three directions in the world.
#pragma once

#include "precompute/factors/brdf_lobes.h"
#include "protocol/brdf/directions.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace relume::materials {

struct FieldModel {
    // out[lobe·k + i] = ρ·cos of a lobe from the i-th of k world directions to the light, in
    // 1/sr; zero below the horizon of the normal where the model has one. `reflection` is the
    // mirrored direction to the viewer. Thread-safe.
    using Evaluate = std::function<void(const Imath::V3f& normal,
                                        const Imath::V3f& reflection,
                                        const brdf::Directions& light,
                                        std::span<float> out)>;

    std::string name;
    std::size_t lobe_count = 1;
    bool depends_on_normal = true;
    bool depends_on_reflection = true;
    double width_rad = 1;  // of the narrowest highlight
    // [lobe_count], what each lobe is multiplied with unless somebody says otherwise.
    std::vector<Imath::V3f> colours{Imath::V3f(1)};
    Evaluate evaluate;
};

// max(ω·n, 0)/π: a white surface, lit from the whole hemisphere.
[[nodiscard]] FieldModel lambert_model();
// (s + 1)/(2π)·max(ω·ω_r, 0)^s, whose integral over the sphere is 1: the highlight of Phong
// without a cosine of the normal, as in [Ng04 §7.1.2]. Exponent s ≥ 0.
[[nodiscard]] FieldModel phong_model(float exponent);
// Any isotropic BRDF by its lobes, times the cosine. A viewer below the horizon of the normal,
// as entries beside a grazing one have it, counts as at the horizon.
[[nodiscard]] FieldModel lobes_model(std::string name, factors::BrdfLobes lobes);

}  // namespace relume::materials
