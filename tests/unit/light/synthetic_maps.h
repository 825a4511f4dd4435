// Environments made from a function of direction, in every projection.
#pragma once

#include "protocol/light/environment_map.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <random>

namespace relume::light::testing {

using Radiance = std::function<Imath::V3f(const Imath::V3f&)>;

// Direction of a place in an image, x and y in [0, 1] from the top left; written from
// protocol/README.md §1 without use of protocol/light. Nothing where a map is blank.
std::optional<Imath::V3f> direction_at(
    Projection projection, std::uint32_t width, std::uint32_t height, double x, double y);

// Each texel is the mean over samples×samples places in it; blank texels are `blank`.
MapImage draw(Projection projection,
              std::uint32_t width,
              std::uint32_t height,
              const Radiance& radiance,
              std::uint32_t samples = 2,
              float blank = 77);

std::shared_ptr<const EnvironmentMap> lat_long_map(std::uint32_t height,
                                                   const Radiance& radiance,
                                                   std::uint32_t samples = 2);

// Black but for one texel.
std::shared_ptr<const EnvironmentMap> one_texel_map(std::uint32_t height,
                                                    std::uint32_t column,
                                                    std::uint32_t row,
                                                    float value);

// Smooth, positive, without any symmetry; different in every colour.
Imath::V3f smooth_radiance(const Imath::V3f& direction);

Imath::Quatf random_rotation(std::mt19937& generator);
Imath::V3f random_direction(std::mt19937& generator);

}  // namespace relume::light::testing
