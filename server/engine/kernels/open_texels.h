// Integrals over the open texels of a receiver, a bit a texel: what needs no wavelets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

// Values of three colours, one array each, of one length: a multiple of 64.
using ColourPlanes = std::array<const float*, 3>;

// Σ over the set bits of planes[colour][texel], the lowest bit of the first word first. Sixteen
// sums go side by side, of texels that are equal modulo 16, each in ascending order; then they
// are added in halves: 0…7 to 8…15, 0…3 to 4…7, and so on. The same bits on every instruction
// set.
[[nodiscard]] std::array<float, 3> sum_open(std::span<const std::uint64_t> open,
                                            const ColourPlanes& planes);
// Σ over the set bits of planes[colour][texel]·factor[texel], by fused multiply-adds in the
// same order.
[[nodiscard]] std::array<float, 3> sum_open_products(std::span<const std::uint64_t> open,
                                                     const ColourPlanes& planes,
                                                     const float* factor);

// The specifications: one value at a time.
[[nodiscard]] std::array<float, 3> sum_open_scalar(std::span<const std::uint64_t> open,
                                                   const ColourPlanes& planes);
[[nodiscard]] std::array<float, 3> sum_open_products_scalar(std::span<const std::uint64_t> open,
                                                            const ColourPlanes& planes,
                                                            const float* factor);

}  // namespace relume::engine
