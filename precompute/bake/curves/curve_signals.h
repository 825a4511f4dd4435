// Signals that stand for what artists make of the curves of a bake (blocks/signal_model.h).
#pragma once

#include "precompute/bake/blocks/signal_model.h"
#include "precompute/bake/curves/edited_material.h"

#include <vector>

namespace relume::bake {

// The coefficients of a signal in red, green and blue (basis/curve_basis.h): one curve for each
// material, diffuse colours as baked.
[[nodiscard]] std::array<std::vector<float>, 3> signal_from_curves(
    std::span<const curve::Curve> curves);

// Natural signals are the curves as baked, narrower, wider, and lifted at their end; the hard
// ones end a curve abruptly, at four places. All are the mean of red, green and blue. A band is
// one level of one curve's wavelets, its scaling coefficient, or one of the other columns; its
// weight is the mean square of its coefficients under the natural signals, and its steps are
// inverse to the root of that (reverse water-filling).
[[nodiscard]] SignalModel curve_signals(const std::vector<EditedMaterial>& materials);

}  // namespace relume::bake
