// PBI for spherical harmonics: bands are filled from the lowest [Overbeck06T fig. 8.1].
#pragma once

#include "tests/lab/methods/planned_contestant.h"

#include <cstdint>
#include <memory>

namespace relume::lab {

// Error of a band, relative to the light: Σ_j Σ_c |L − L̃| over the band's columns over the same
// of |L| over all columns. The figure names no norm; L1 is what section 6.2 finds best.
//
// Bands take turns from the lowest: a band takes its largest differences, one at a time, until
// its error is at most the tolerance; then the next band does. After the last band the
// tolerance is a tenth, and the lowest band goes on. This ends when `columns` differences are
// chosen or what is left of the light is below `kNegligibleError`. No band begins anew: every
// band is incremental. A band is put in order once an image; then each choice is constant time.
inline constexpr double kFirstTolerance = 0.0005;
inline constexpr double kToleranceFactor = 0.1;
inline constexpr double kNegligibleError = 1e-12;

[[nodiscard]] std::unique_ptr<PlanMaker> make_band_filling(std::uint32_t columns);

}  // namespace relume::lab
