// The lights that the laws are tried under, as functions and as the cubemaps they become.
#pragma once

#include "tests/support/reference_tracer/sky.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::test {

// A gradient from a bluish zenith to a warm horizon and dark ground, and a sun of 3° radius
// that gives about as much as all the rest.
[[nodiscard]] Imath::V3d sun_and_gradient(const Imath::V3d& direction);

// A lat-long picture as a function, filtered bilinearly; negative and non-finite texels are
// black. Throws std::runtime_error where the file cannot be read.
[[nodiscard]] reference::Sky::Radiance radiance_from_lat_long(
    const std::filesystem::path& path);

// Mean radiance over each of the 6·n² texels, by solid angle.
[[nodiscard]] std::vector<Imath::V3f> cubemap_from_function(
    std::uint32_t n, const reference::Sky::Radiance& radiance);

}  // namespace relume::test
