// The integral of a product of three functions on a cubemap, from some coefficients of light
// and material [Ng04 §5.3]: the specification of the engine's kernel, written as it is
// published.
#pragma once

#include "protocol/tripling/sparse_wavelets.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace relume::tripling {

// Parent sums of a function, each found when it is first asked for and remembered. Refers to
// the function. Not for several threads.
class LazyParentSums {
  public:
    explicit LazyParentSums(const SparseWavelets& function) : function_(function) {}

    // The value, over all of the square, of the function's part of coarser levels. Climbs until
    // it meets a square whose sum is known.
    [[nodiscard]] double at(std::size_t square);
    // How many sums have been found so far.
    [[nodiscard]] std::size_t known_count() const { return known_.size(); }

  private:
    const SparseWavelets& function_;
    std::unordered_map<std::size_t, double> known_;
};

// Σ_texels L·V·ρ̃, as far as these terms go, all of one face resolution:
//  - scaling functions with each other (case 1 of haar_tripling.h);
//  - per square of `material`: case 2, and case 3 where ρ̃ is one of the pair, with all that
//    `light` and `visibility` hold;
//  - per square of `light_terms`: case 3 where light and visibility are the pair, with all that
//    `material` holds.
// `light_terms` are squares of `light`. Where `light_terms` is all of them, and light,
// visibility and material hold all their coefficients, the integral is exact.
[[nodiscard]] double sublinear_triple_integral(const SparseWavelets& light,
                                               const SquareSet& light_terms,
                                               const SparseWavelets& visibility,
                                               const SparseWavelets& material);

}  // namespace relume::tripling
