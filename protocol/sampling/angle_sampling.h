// Directions of the light whose half vector, or whose angle to the mirrored viewer, is spread
// evenly over the samples of a curve: u² · 90° of it is uniform in u, as is the azimuth, so
// that every sample of a curve is met however the light is. Local frame, z along the normal.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>

namespace relume::sampling {

enum class SampledAngle : std::uint8_t { half, reflection };

struct AngleSample {
    Imath::V3f wi{0, 0, 0};  // unit
    float pdf = 0;           // per steradian; 0 where wi is not above the horizon
};

// `u` in [0, 1)²: of the angle, of the azimuth.
[[nodiscard]] AngleSample sample_angle(SampledAngle angle,
                                       const Imath::V3f& wo,
                                       const Imath::V2f& u);
// Density with which sample_angle returns wi.
[[nodiscard]] float angle_pdf(SampledAngle angle, const Imath::V3f& wi, const Imath::V3f& wo);

}  // namespace relume::sampling
