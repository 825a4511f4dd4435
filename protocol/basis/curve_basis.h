// The basis of a signal that says how surfaces reflect, in place of the light: one column for
// what nobody edits, and for each edited material its diffuse colour and one curve of its BRDF
// in 256 Daubechies-4 wavelets (daubechies4.h).
//
// Coefficient 0 is `rest`, always 1. Those of curve m are first = 1 + 257·m, the diffuse
// colour, and first + 1 + j, the curve's wavelet coefficient j. Band 0 holds the rest, the
// diffuse colours and every curve's scaling coefficient; band 1 + ℓ the wavelets of level
// ℓ = 0 … 7 of all curves. The octave of band 0 is 0, that of band 1 + ℓ is ℓ.
#pragma once

#include "protocol/basis/bands.h"

#include <cstddef>
#include <cstdint>

namespace relume::basis {

class CurveBasis {
  public:
    static constexpr std::uint32_t kMostCurves = 16;

    // Throws std::invalid_argument unless 1 ≤ curve_count ≤ kMostCurves.
    explicit CurveBasis(std::uint32_t curve_count);

    [[nodiscard]] std::uint32_t curve_count() const { return curve_count_; }
    // 1 + 257·curve_count.
    [[nodiscard]] std::size_t coefficient_count() const;
    // 9.
    [[nodiscard]] std::uint32_t band_count() const;
    // `coefficient` is below coefficient_count().
    [[nodiscard]] std::uint32_t band_from_coefficient(std::size_t coefficient) const;
    [[nodiscard]] float octave_from_band(std::uint32_t band) const;
    [[nodiscard]] Bands bands() const;

    static constexpr std::size_t kRest = 0;
    // The diffuse colour of curve m's material; the curve's coefficients follow it.
    [[nodiscard]] std::size_t first_coefficient(std::uint32_t curve) const;

    friend bool operator==(const CurveBasis&, const CurveBasis&) = default;

  private:
    std::uint32_t curve_count_;
};

}  // namespace relume::basis
