// Tripling coefficients of the 2-D Fourier basis [Ng04 §4.3], over the n² points of a grid:
//     ψ_(l,k)(row, column) = 1/n · exp(2πi (l·row + k·column)/n),
// orthonormal as Σ ψ_u ψ*_v, and their tripling coefficient is Σ ψ_u ψ_v ψ*_w, as is usual for
// complex functions. It is 1/n where the frequencies of w are the sums of those of u and v, and
// 0 otherwise.
#pragma once

#include <cstdint>

namespace relume::tripling {

struct Frequency {
    std::int32_t along_rows = 0;
    std::int32_t along_columns = 0;
};

// On a grid, frequencies that differ by a multiple of n are one function. n ≥ 1, not
// necessarily a power of two.
[[nodiscard]] double fourier_tripling(std::uint32_t n,
                                      const Frequency& u,
                                      const Frequency& v,
                                      const Frequency& w);

// Ordered triples with a coefficient that is not zero among the N = (2M + 1)² functions whose
// frequencies lie in [−M, M], on a grid of at least 3M + 1 points a side: (1 + 3M + 3M²)²,
// which is (1 + 3N)²/16 [Ng04 App. B.1]. On a smaller grid sums wrap around, and there are
// more.
[[nodiscard]] std::uint64_t fourier_tripling_count(std::uint32_t band_limit);

}  // namespace relume::tripling
