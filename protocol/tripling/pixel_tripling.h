// Tripling coefficients of texels as basis functions [Ng04 §4.2]: functions that are 1 in one
// texel and 0 elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::tripling {

[[nodiscard]] constexpr double pixel_tripling(std::size_t u, std::size_t v, std::size_t w) {
    return u == v && v == w ? 1 : 0;
}

// Ordered triples of `function_count` texels whose coefficient is not zero.
[[nodiscard]] constexpr std::uint64_t pixel_tripling_count(std::uint64_t function_count) {
    return function_count;
}

}  // namespace relume::tripling
