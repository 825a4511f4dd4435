// A number that names the inputs of a bake: scene, camera, parameters, generator.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/scene/camera.h"
#include "precompute/scene/scene.h"

#include <cstdint>
#include <string_view>

namespace relume::bake {

// XXH3-64 of everything that changes the result. Names of meshes and materials do not count,
// nor does the number of threads. `signal`: what the signal is, where it is not light.
[[nodiscard]] std::uint64_t fingerprint_of(const scene::Scene& scene,
                                           const scene::Camera& camera,
                                           const BakeParameters& parameters,
                                           std::string_view generator,
                                           std::string_view signal = {});

}  // namespace relume::bake
