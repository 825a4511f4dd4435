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

// How exact the integral over a texel is. The reflections of several points are averaged where
// a surface turns within its receiver, and what each is off by goes under in how they differ:
// one of many takes or leaves a texel at the horizon as a whole, by its centroid, and takes the
// lobe there unless it is narrower than the texel.
enum class TexelDetail : std::uint8_t { sole_point, one_of_many };

// grey: ∫ cos θ dω / π, so that grey × albedo is the response.
void reflect_light(const LightTexels& texels,
                   const scene::SurfacePoint& point,
                   Reflection& reflection,
                   TexelDetail detail = TexelDetail::sole_point);

}  // namespace relume::bake
