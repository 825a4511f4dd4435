// Integrals over the open texels of a receiver whose material is a sum of a few functions that
// are tabulated by texels: light times visibility times material without wavelets, exactly.
#pragma once

#include "protocol/tripling/texel_store.h"
#include "server/engine/kernels/open_texels.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// Functions that are summed at one receiver, at most.
inline constexpr std::size_t kMostMixed = 16;

struct WeightedTexels {
    float weight = 0;
    tripling::TexelView function;
};

// Σ over the set bits of planes[colour][texel]·Σ_i weight_i·function_i[texel]: a bit a texel
// of a cubemap as `functions` are of, planes of as many values, up to a multiple of 64. The
// inner sum is made by fused multiply-adds from zero in the order of the functions, and added
// as sum_open_products (open_texels.h) adds; runs of texels that no function has are passed by.
// At most kMostMixed functions. The same bits on every instruction set.
[[nodiscard]] std::array<float, 3> sum_open_mixture(std::span<const std::uint64_t> open,
                                                    const ColourPlanes& planes,
                                                    std::span<const WeightedTexels> functions);

// The specification: one value at a time.
[[nodiscard]] std::array<float, 3> sum_open_mixture_scalar(
    std::span<const std::uint64_t> open,
    const ColourPlanes& planes,
    std::span<const WeightedTexels> functions);

}  // namespace relume::engine
