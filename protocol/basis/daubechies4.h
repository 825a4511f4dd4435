// The periodised Daubechies wavelets of two vanishing moments, four taps, on 256 samples,
// orthonormal [Daubechies88]: the basis in which a curve of a BRDF is written [BenArtzi06].
//
// With h = (1+√3, 3+√3, 3−√3, 1−√3)/(4√2) and g = (h3, −h2, h1, −h0), one step makes n values s
// into n/2 averages and n/2 differences,
//     a_i = Σ_k h_k s_{(2i+k) mod n},   d_i = Σ_k g_k s_{(2i+k) mod n},   k = 0 … 3,
// and recurses on the averages until one is left (n = 256, 128, …, 2). Coefficient 0 is the
// last average, coefficient 2^ℓ + i the i-th difference of the step that leaves 2^ℓ averages, a
// wavelet of level ℓ = 0 (coarsest) … 7. The last step, n = 2, is that of Haar.
//
// Wavelets that do not reach around the end are orthogonal to lines. A constant c is 16·c in
// coefficient 0 alone. Sums are made in double precision, in the order written. Thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::basis {

inline constexpr std::size_t kDaubechies4Size = 256;
inline constexpr std::uint32_t kDaubechies4Levels = 8;

// `samples` and `coefficients` may be the same values.
void daubechies4_forward(std::span<const float, kDaubechies4Size> samples,
                         std::span<float, kDaubechies4Size> coefficients);
void daubechies4_inverse(std::span<const float, kDaubechies4Size> coefficients,
                         std::span<float, kDaubechies4Size> samples);

}  // namespace relume::basis
