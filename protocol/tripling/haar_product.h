// The product of two functions on one face, from Haar coefficients to Haar coefficients,
// without going through texels [Ng04 §3.2, eq. 10]: G_u = Σ_v Σ_w C_uvw E_v F_w.
#pragma once

#include <cstdint>
#include <span>

namespace relume::tripling {

// e, f and g are n² coefficients in the order of haar.h, n any power of two; g overlaps neither
// of the others. In O(N): parent sums go down, sums of products over finer squares come up.
void haar_product(std::uint32_t n,
                  std::span<const double> e,
                  std::span<const double> f,
                  std::span<double> g);

}  // namespace relume::tripling
