// From curves of materials to the coefficients of a signal (curve_basis.h), a colour at a time.
//
// Pure functions; thread-safe.
#pragma once

#include "protocol/basis/curve_basis.h"
#include "protocol/basis/daubechies4.h"

#include <cstdint>
#include <span>

namespace relume::basis {

// Sets what nobody edits to 1. `coefficients` are as many as the basis has, here and below.
void project_rest(std::span<float> coefficients);
// Sets what curve `curve` and its material's diffuse colour are; `diffuse` 1 is as baked.
void project_curve(const CurveBasis& basis,
                   std::uint32_t curve,
                   float diffuse,
                   std::span<const float, kDaubechies4Size> samples,
                   std::span<float> coefficients);

}  // namespace relume::basis
