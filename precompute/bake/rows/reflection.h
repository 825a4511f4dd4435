// What every texel of an unoccluded light would add to a point: ∫ f cos θ dω over the texel.
//
// - Lambert: exact. The texel's vector irradiance times the normal; texels that cross the
//   geometric or the shading horizon are clipped.
// - Glossy: the lobe at the texel's centroid where it is smooth across the texel; a grid of
//   midpoints where it is not; and where it peaks too sharply for that, the lobe's own samples,
//   so that a highlight however narrow keeps its energy. Texels near the peak are kept in
//   sixteen parts, for each part has a visibility of its own.
#pragma once

#include "precompute/bake/rows/light_texels.h"
#include "precompute/scene/surface_point.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relume::bake {

// A texel in a 4×4 grid of parts, row by row.
struct SplitTexel {
    std::uint32_t place = 0;
    std::array<std::array<float, kPacketSize>, 3> rgb{};
};

// By place. Diffuse points fill `grey` alone, without their albedo; others fill `rgb` (each
// split texel holding the sum of its parts) and `split`.
struct Reflection {
    bool is_diffuse = true;
    std::vector<float> grey;
    std::array<std::vector<float>, 3> rgb;
    std::vector<SplitTexel> split;
    std::vector<float> projected;                 // scratch: solid angle above both horizons
    std::array<std::vector<float>, 3> direction;  // scratch
};

// grey: ∫ cos θ dω / π, so that grey × albedo is the response.
void reflect_light(const LightTexels& texels,
                   const scene::SurfacePoint& point,
                   Reflection& reflection);

}  // namespace relume::bake
