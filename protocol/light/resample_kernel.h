// The inner loop of rotation_resample.h, compiled for several vector widths.
#pragma once

#include "protocol/basis/cubemap.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>

namespace relume::light {

// One face of the output in source space: its points are normal + u·u_axis + v·v_axis.
struct RotatedFace {
    Imath::V3f normal;
    Imath::V3f u_axis;
    Imath::V3f v_axis;
};
using ResampleFaces = std::array<RotatedFace, basis::kFaceCount>;

struct ResampleJob {
    const float* texels;  // as PrefilteredEnvironment::padded_texels
    std::uint32_t inner_resolution;
    std::uint32_t face_resolution;
    ResampleFaces faces;
    Imath::V3f scale;
    bool accumulate;
    float* out;  // 3 planes of 6·n²
};

// Writes one row of all six faces: each texel is the mean of eight bilinear samples, weighted
// by the solid angle each stands for. The same bits on every machine.
void resample_row(const ResampleJob& job, std::uint32_t row);

}  // namespace relume::light
