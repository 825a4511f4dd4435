// Tripling coefficients of spherical harmonics: ∫ Y_u Y_v Y_w dω over the sphere, from
// Clebsch-Gordan coefficients [Inui90, Ng04 §4.4]. The real functions are those of
// spherical_harmonics.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace relume::tripling {

// Harmonics with l below this; sums of factorials lose digits as l grows.
inline constexpr std::uint32_t kMostTriplingOrder = 12;

// Y(l, m), with |m| ≤ l.
struct Harmonic {
    std::uint32_t l = 0;
    std::int32_t m = 0;
};

// ⟨l1 m1 l2 m2 | l m⟩ by Racah's formula, 0 wherever it is not defined. To some 10⁻¹² for l
// below kMostTriplingOrder.
[[nodiscard]] double clebsch_gordan(const Harmonic& first,
                                    const Harmonic& second,
                                    const Harmonic& product);

// ∫ Y_u Y_v Y*_w of complex harmonics with the Condon–Shortley sign. It is not zero only where
// m_w = m_u + m_v, |l_u − l_v| ≤ l_w ≤ l_u + l_v, and l_u + l_v + l_w is even.
[[nodiscard]] double complex_sh_tripling(const Harmonic& u,
                                         const Harmonic& v,
                                         const Harmonic& w);

// ∫ Y_u Y_v Y_w of the real harmonics u, v, w = l² + l + m of order below kMostTriplingOrder.
[[nodiscard]] double sh_tripling(std::size_t u, std::size_t v, std::size_t w);

// Ordered triples of complex harmonics up to l = L that satisfy the constraints on m and the
// triangle of l: 9/20 L⁵ + 9/4 L⁴ + 19/4 L³ + 21/4 L² + 33/10 L + 1 [Ng04 App. B.2]. The
// formula leaves out the constraint on l_u + l_v + l_w and counts some Clebsch-Gordan
// coefficients that are zero: it bounds the number of tripling coefficients from above.
[[nodiscard]] std::uint64_t sh_tripling_bound(std::uint32_t most_l);

}  // namespace relume::tripling
