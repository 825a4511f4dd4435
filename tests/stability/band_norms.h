// Sums over the wavelets of a band, by which PBI decides.
#pragma once

#include "server/scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::stability {

// Σ |a_j − b_j| over the coefficients of each band and all colours, planar [3][N]; b may be
// empty and is zero then.
[[nodiscard]] std::vector<double> band_l1(const served::Scene& scene,
                                          std::span<const float> a,
                                          std::span<const float> b = {});

// ‖L_b − L̃_b‖₁ / ‖L_b‖₁ of the worst band: 1 when a band shows nothing, more when it shows
// something worse than nothing.
[[nodiscard]] double worst_band_residual(const served::Scene& scene,
                                         std::span<const float> target,
                                         std::span<const float> approximation);

}  // namespace relume::stability
