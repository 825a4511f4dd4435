// A function on a cubemap by some of its Haar coefficients: those of the six scaling functions,
// and three a square of a set.
#pragma once

#include "protocol/tripling/square_set.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::tripling {

using SquareCoefficients = std::array<float, 3>;  // in the order of kWaveletTypes

// Immutable; safe to share between threads.
class SparseWavelets {
  public:
    // The squares of `kept` from 6·n² coefficients in the order of haar.h.
    SparseWavelets(const SquareSet& kept, std::span<const float> coefficients);
    // The values of each square of `kept`, in the order of their numbers.
    SparseWavelets(SquareSet kept,
                   const std::array<float, basis::kFaceCount>& scaling,
                   std::vector<SquareCoefficients> values);

    [[nodiscard]] std::uint32_t face_resolution() const { return squares_.face_resolution(); }
    [[nodiscard]] const SquareSet& squares() const { return squares_; }
    [[nodiscard]] std::span<const float> scaling() const { return scaling_; }
    // [squares().size()]
    [[nodiscard]] std::span<const SquareCoefficients> values() const { return values_; }
    // Zeros where the set has no such square.
    [[nodiscard]] SquareCoefficients at(std::size_t square) const {
        return squares_.contains(square) ? values_[squares_.rank(square)]
                                         : SquareCoefficients{};
    }
    // Coefficients of wavelets that are not zero.
    [[nodiscard]] std::size_t nonzero_count() const;
    [[nodiscard]] std::vector<float> coefficients() const;  // 6·n², in the order of haar.h

  private:
    SquareSet squares_;
    std::array<float, basis::kFaceCount> scaling_{};
    std::vector<SquareCoefficients> values_;
};

// Squares that have a coefficient that is not zero.
[[nodiscard]] SquareSet nonzero_squares(std::uint32_t n, std::span<const float> coefficients);

// Which of several approximations is the best one of its size.
enum class TermOrder : std::uint8_t {
    by_size,  // least squared error over texels
    by_area   // size times 2^−level, a wavelet's amplitude times its area [Ng03 §4.1]
};

// The squares of the `term_count` first wavelets, the scaling functions not counted.
[[nodiscard]] SquareSet largest_squares(std::uint32_t n,
                                        std::span<const float> coefficients,
                                        std::size_t term_count,
                                        TermOrder order);

// The squares of most energy with all squares on their way to the roots: so many that they and
// the scaling functions hold `energy_fraction` in [0, 1] of Σ coefficient².
[[nodiscard]] SquareSet squares_of_energy(std::uint32_t n,
                                          std::span<const float> coefficients,
                                          double energy_fraction);

}  // namespace relume::tripling
