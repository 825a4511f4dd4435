// Tripling coefficients of the 2-D Haar basis of haar.h: Σ_texels ψ_u ψ_v ψ_w over one face, by
// the theorem of [Ng04 §4.5.2].
//
// The coefficient of u, v, w is not zero in exactly three cases:
//  1. all three are the scaling function: 1/n;
//  2. all three live in one square and are of three types: 2^level/n;
//  3. two are one wavelet, and the third is the scaling function or a wavelet that overlaps it
//  at
//     a coarser level: ± 2^level/n of the coarser one, with its sign in the quarter where the
//     finer one lies.
// [Ng04] has functions that are orthonormal over the unit square, whose coefficients are n
// times these. No coefficient joins two faces of a cubemap.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::tripling {

// Value of basis function `coefficient` at a texel of a face, n any power of two.
[[nodiscard]] double haar_value(std::uint32_t n,
                                std::size_t coefficient,
                                std::uint32_t row,
                                std::uint32_t column);

// u, v, w in [0, n²), in the order of haar.h.
[[nodiscard]] double haar_tripling(std::uint32_t n,
                                   std::size_t u,
                                   std::size_t v,
                                   std::size_t w);

// How many ordered triples (u, v, w) of the N = n² functions of a face have a coefficient that
// is not zero, by the case of the theorem. With a = log4 N:
//     1,   2(N − 1),   9(1 − N + N·a),   together 8 − 7N + 9N·a.
// [Ng04 App. B.3] counts a pair of case 3 with its third function once, whichever of the three
// factors is the third, and comes to 2 − N + 3N·a: `unordered_case_3` is what is counted there.
struct HaarTriplingCount {
    std::uint64_t case_1 = 0;
    std::uint64_t case_2 = 0;
    std::uint64_t case_3 = 0;
    std::uint64_t unordered_case_3 = 0;

    [[nodiscard]] std::uint64_t total() const { return case_1 + case_2 + case_3; }
    [[nodiscard]] std::uint64_t as_in_appendix_b() const {
        return case_1 + case_2 + unordered_case_3;
    }
};
[[nodiscard]] HaarTriplingCount haar_tripling_count(std::uint32_t n);

}  // namespace relume::tripling
