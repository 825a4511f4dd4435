// The 2-D non-standard Haar basis, orthonormal, one square face at a time [Ng03 §3,
// Stollnitz95].
//
// Coefficients lie where Mallat's pyramid puts them, row-major in the n×n face. The scaling
// coefficient is at (0,0). The wavelets of level ℓ (ℓ = 0 is the coarsest, 2^ℓ×2^ℓ positions)
// fill three squares of side 2^ℓ: differences along columns from (row 0, column 2^ℓ), along
// rows from (2^ℓ, 0), along both from (2^ℓ, 2^ℓ). One step maps a 2×2 cell
//     p q          (p+q+r+s)/2   (p−q+r−s)/2
//     r s    to    (p+q−r−s)/2   (p−q−r+s)/2
// and recurses on the averages. The transform is its own transpose's inverse, so
// Σ_texels T·L = Σ_coefficients (HT)·(HL), and both have the same energy.
//
// Coefficient index j = face·n² + row·n + column. Band b holds the wavelets of level b;
// band 0 holds the scaling functions too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::basis {

// `face` holds n·n values, n a power of two. `scratch` holds at least n·n values and does not
// overlap it.
void haar_forward(std::uint32_t n, std::span<float> face, std::span<float> scratch);
void haar_inverse(std::uint32_t n, std::span<float> face, std::span<float> scratch);

// All six faces of a planar cubemap of 6·n² values.
void haar_forward_cubemap(std::uint32_t n, std::span<float> cubemap);
void haar_inverse_cubemap(std::uint32_t n, std::span<float> cubemap);

// Bands of a cubemap of resolution n: log2 n.
[[nodiscard]] std::uint32_t band_count(std::uint32_t n);
// Band of coefficient j, in [0, band_count(n)).
[[nodiscard]] std::uint32_t band_from_coefficient(std::uint32_t n, std::size_t coefficient);

}  // namespace relume::basis
