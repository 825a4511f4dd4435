// Real spherical harmonics, orthonormal over the sphere, as polynomials of the unit direction
// [Sloan13]; the polar axis is the world's z, and there is no Condon–Shortley sign:
//     Y(0,0) = √(1/4π)    Y(1,−1) = √(3/4π)·y    Y(1,0) = √(3/4π)·z    Y(1,1) = √(3/4π)·x
//     Y(l, m) = √2·N(l,m)·|P(l,m)|(z)·cos mφ,  Y(l,−m) = √2·N(l,m)·|P(l,m)|(z)·sin mφ,  m > 0
// where |P| is the associated Legendre function without sign and N its normalisation.
//
// *Order* counts bands, as in [Sloan02]: order k holds the bands l = 0 … k−1, k² functions, the
// function of band l and −l ≤ m ≤ l at index l² + l + m.
#pragma once

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::basis {

inline constexpr std::uint32_t kMaxShOrder = 20;

[[nodiscard]] constexpr std::size_t sh_count(std::uint32_t order) {
    return std::size_t{order} * order;
}
[[nodiscard]] constexpr std::size_t sh_index(std::uint32_t l, std::int32_t m) {
    return static_cast<std::size_t>(std::int64_t{l} * l + l + m);
}
// l of the function at an index.
[[nodiscard]] std::uint32_t sh_band_from_index(std::size_t index);

// values[k²] at a unit direction, to some 10⁻¹⁴ of their size up to order 21 at least: the
// recurrences over l are those that lose no digits, and no factorial is formed.
void evaluate_sh(std::uint32_t order, const Imath::V3d& direction, std::span<double> values);

// Under mirrors at the planes x = 0, y = 0, z = 0 a function keeps its value or changes its
// sign: bit 0, 1, 2 is set where it is odd in x, y, z.
[[nodiscard]] std::uint32_t sh_parity(std::size_t index);

}  // namespace relume::basis
