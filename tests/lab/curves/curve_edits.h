// How people edit a curve: sequences of images in which one changes, and single changes.
#pragma once

#include "protocol/curve/curve.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace relume::lab {

// What an edit changes.
//   local          a bump a tenth of the curve wide moves along it
//   global         the width of the whole curve sweeps, as roughness does
//   discontinuous  a step between two levels jumps to other places
//   random         every sample takes any value
enum class CurveChange : std::uint8_t { local, global, discontinuous, random };

inline constexpr std::array<CurveChange, 4> kCurveChanges{
    CurveChange::local, CurveChange::global, CurveChange::discontinuous, CurveChange::random};

[[nodiscard]] std::string_view name_of(CurveChange change);

// The curve of image `number` of a drag that begins at `baked`. The same arguments give the
// same curve. Values are of the size of those of `baked`.
[[nodiscard]] curve::Curve changed_curve(const curve::Curve& baked,
                                         CurveChange change,
                                         std::uint32_t number);

}  // namespace relume::lab
