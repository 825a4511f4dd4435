// A stroke: values that are drawn over a part of a curve. Only samples with from ≤ u ≤ to
// change; of these, sample k becomes c + w·(s − c), c being what it was, s the stroke's value
// at its u, linear between the stroke's values, which are spaced evenly from `from` to `to`,
// and w = x²(3 − 2x) with x the distance to the nearer end in units of `softness`, at most 1;
// w = 1 everywhere if softness is 0. Pure; thread-safe.
#pragma once

#include "protocol/curve/curve.h"

#include <Imath/ImathVec.h>

#include <cstddef>
#include <vector>

namespace relume::curve {

struct Stroke {
    static constexpr std::size_t kMostValues = kCurveSamples;

    double from = 0;
    double to = 1;
    double softness = 0;             // in u, 0 … 1
    std::vector<Imath::V3d> values;  // 1 … kMostValues
};

// Throws CurveError unless 0 ≤ from ≤ to ≤ 1, softness is in [0, 1], and there are 1 …
// kMostValues values in [0, kMostCurveValue].
[[nodiscard]] Curve with_stroke(const Curve& curve, const Stroke& stroke);

}  // namespace relume::curve
