// Light that a surface scatters evenly: Lambert's, or below a dielectric's coat.
#pragma once

#include <Imath/ImathVec.h>

#include <numbers>
#include <optional>

namespace relume::brdf {

inline constexpr float kDielectricF0 = 0.04F;

inline float schlick_weight(float cosine) {
    const float m = 1.0F - cosine;
    const float m2 = m * m;
    return m2 * m2 * m;
}

// The dielectric over the diffuse layer, by Schlick: f0 straight on, f90 at grazing angles.
struct Coat {
    float f0 = kDielectricF0;
    float f90 = 1;

    // What it lets through at this angle.
    [[nodiscard]] float transmission(float cosine) const {
        return (1.0F - f0) - (f90 - f0) * schlick_weight(cosine);
    }
    // Diffuse layer below the coat, per unit of colour, with transmission(θo) folded in by the
    // caller [Shirley97]. The cosine-weighted mean of Schlick's term is f0 + (f90 − f0)/21.
    [[nodiscard]] float diffuse_share() const {
        const float mean_transmission = 1.0F - f0 - (f90 - f0) / 21.0F;
        return mean_transmission > 1e-4F ? std::numbers::inv_pi_v<float> / mean_transmission
                                         : 0.0F;
    }

    friend bool operator==(const Coat&, const Coat&) = default;
};

// f = colour/π, or below a coat colour·(1−F(θi))(1−F(θo))/(π (1−F̄)).
struct DiffuseLobe {
    Imath::V3f colour{0, 0, 0};
    std::optional<Coat> coat{};

    // f·cos θi of two directions above the horizon, by their cosines.
    [[nodiscard]] Imath::V3f times_cosine(float cos_i, float cos_o) const {
        const float share =
            coat ? coat->diffuse_share() * coat->transmission(cos_o) * coat->transmission(cos_i)
                 : std::numbers::inv_pi_v<float>;
        return colour * (share * cos_i);
    }
};

}  // namespace relume::brdf
