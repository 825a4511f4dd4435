// The direction in which a few rows differ most.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

using Rows = std::span<const std::span<const float>>;  // of equal length

// How far each of some rows, by number, lies along their first principal axis, by a few steps
// of power iteration from the row that is farthest from the mean. None where all are equal.
[[nodiscard]] std::vector<double> along_widest_axis(Rows rows,
                                                    std::span<const std::uint32_t> some);

}  // namespace relume::bake
