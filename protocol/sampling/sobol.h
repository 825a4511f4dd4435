// Two-dimensional Sobol points with hash-based Owen scrambling [Burley20], padded to as many
// dimensions as a path needs.
#pragma once

#include "protocol/transport/hash.h"

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::sampling {

[[nodiscard]] constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = (x << 16U) | (x >> 16U);
    x = ((x & 0x00ff00ffU) << 8U) | ((x & 0xff00ff00U) >> 8U);
    x = ((x & 0x0f0f0f0fU) << 4U) | ((x & 0xf0f0f0f0U) >> 4U);
    x = ((x & 0x33333333U) << 2U) | ((x & 0xccccccccU) >> 2U);
    return ((x & 0x55555555U) << 1U) | ((x & 0xaaaaaaaaU) >> 1U);
}

// Scrambles bit by bit from the top, each by a hash of those above [Laine11, Vegdahl21].
[[nodiscard]] constexpr std::uint32_t owen_scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed_bits(x);
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return reversed_bits(x);
}

// Point `index` of sequence `key`, in [0, 1)². Any aligned run of 2^k indices is a (0,k,2)-net,
// and sequences of different keys are independent of each other.
[[nodiscard]] constexpr Imath::V2f sobol_point(std::uint32_t index, std::uint64_t key) {
    const std::uint64_t order = transport::mix_bits(key);
    const std::uint64_t scramble = transport::mix_bits(order);
    const std::uint32_t i = owen_scrambled(index, static_cast<std::uint32_t>(order));
    std::uint32_t second = 0;
    for (std::uint32_t bits = i, v = 0x80000000U; bits != 0; bits >>= 1U, v ^= v >> 1U) {
        second ^= (bits & 1U) != 0 ? v : 0U;
    }
    const std::uint32_t x =
        owen_scrambled(reversed_bits(i), static_cast<std::uint32_t>(scramble));
    const std::uint32_t y = owen_scrambled(second, static_cast<std::uint32_t>(scramble >> 32U));
    return {static_cast<float>(x >> 8U) * 0x1p-24F, static_cast<float>(y >> 8U) * 0x1p-24F};
}

// Interleaves the low 16 bits of x (even bits) and y (odd bits).
[[nodiscard]] constexpr std::uint32_t morton_index(std::uint32_t x, std::uint32_t y) {
    const auto spread = [](std::uint32_t v) {
        v &= 0xffffU;
        v = (v | (v << 8U)) & 0x00ff00ffU;
        v = (v | (v << 4U)) & 0x0f0f0f0fU;
        v = (v | (v << 2U)) & 0x33333333U;
        return (v | (v << 1U)) & 0x55555555U;
    };
    return spread(x) | (spread(y) << 1U);
}

// The even bits of a Morton index.
[[nodiscard]] constexpr std::uint32_t morton_even(std::uint32_t v) {
    v &= 0x55555555U;
    v = (v | (v >> 1U)) & 0x33333333U;
    v = (v | (v >> 2U)) & 0x0f0f0f0fU;
    v = (v | (v >> 4U)) & 0x00ff00ffU;
    return (v | (v >> 8U)) & 0x0000ffffU;
}

}  // namespace relume::sampling
