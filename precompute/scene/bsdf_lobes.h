// The scalar formulae behind Bsdf, each written once and shared by the one-direction and the
// batch code so that both give the same bits. Shading frame, z > 0 assumed throughout.
#pragma once

#include "protocol/brdf/diffuse_lobe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace relume::scene::lobes {

inline constexpr float kInversePi = std::numbers::inv_pi_v<float>;
using brdf::Coat;
using brdf::schlick_weight;

// GGX distribution from the half vector (x, y, z). 1 − z² is taken as x² + y²: at roughness
// 0.05 the difference would have lost all its bits.
inline float ggx_distribution(float alpha2, float sin2, float cosine) {
    const float denominator = alpha2 * cosine * cosine + sin2;
    return alpha2 * kInversePi / (denominator * denominator);
}

inline float smith_root(float alpha2, float cosine) {
    return std::sqrt(cosine * cosine * (1.0F - alpha2) + alpha2);
}

// Height-correlated G2 / (4 cos θi cos θo) [Heitz14].
inline float smith_visibility(float cos_i, float root_i, float cos_o, float root_o) {
    return 0.5F / (cos_i * root_o + cos_o * root_i);
}

// G1 / (2 cos θ): what [Heitz18]'s density of visible normals needs.
inline float smith_masking(float cosine, float root) {
    return 1.0F / (cosine + root);
}

// Exponents are whole sixteenths, so that a power is products and square roots alone: exact
// rounding at every step, hence the same bits on every machine, and it vectorises.
inline constexpr float kExponentSteps = 16.0F;

// x[i] ← x[i]^(sixteenths/16) for count values in [0, 1].
inline void power(float* x, std::size_t count, std::uint32_t sixteenths) {
    constexpr std::size_t kChunk = 64;
    for (std::size_t start = 0; start < count; start += kChunk) {
        float* base = x + start;
        const std::size_t n = std::min(kChunk, count - start);
        float result[kChunk];
        float root[kChunk];
        std::fill_n(result, n, 1.0F);
        std::copy_n(base, n, root);
        for (std::uint32_t bit = 8; bit > 0; bit /= 2) {  // 1/2, 1/4, 1/8, 1/16
            for (std::size_t i = 0; i < n; ++i)
                root[i] = std::sqrt(root[i]);
            if ((sixteenths & bit) != 0) {
                for (std::size_t i = 0; i < n; ++i)
                    result[i] *= root[i];
            }
        }
        for (std::uint32_t whole = sixteenths / 16; whole > 0; whole /= 2) {
            if ((whole & 1U) != 0) {
                for (std::size_t i = 0; i < n; ++i)
                    result[i] *= base[i];
            }
            for (std::size_t i = 0; i < n; ++i)
                base[i] *= base[i];
        }
        std::copy_n(result, n, base);
    }
}

}  // namespace relume::scene::lobes
