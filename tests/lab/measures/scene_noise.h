// Bakes of a scene with given parameters, against its reference, under several lights.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/scene/scene.h"
#include "protocol/transport/manifest.h"
#include "tests/lab/measures/bake_noise.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace relume::lab {

// Lights by name as load_environment takes them, turned by `yaw_degrees` about +Y. Throws
// light::EnvironmentError.
[[nodiscard]] std::vector<ReferenceLight> environment_lights(
    const std::vector<std::string>& names, double yaw_degrees, std::uint32_t face_resolution);

// The lights by which a bake estimates its own error: so many of natural light, then so many
// suns.
inline constexpr std::size_t kModelLights = 4;
[[nodiscard]] std::vector<ReferenceLight> model_lights(std::uint32_t face_resolution);

// Means and sums over the seeds.
struct SceneNoise {
    std::vector<BakeNoise> lit;                // by light, sums
    std::vector<std::vector<float>> pictures;  // by light, of the first seed
    double stated_natural = 0;                 // the bakes' own estimates, root mean square
    double stated_sun = 0;
    double visibility_rays = 0;  // a bake
    double path_rays = 0;        // a bake
    double cpu_seconds = 0;      // a bake, of paths and rows

    // Relative L2 over all kinds of pixels, of lights [first, first + count).
    [[nodiscard]] double relative_l2(std::size_t first, std::size_t count) const;
};

// Bakes with seeds 1 … `seeds` into `directory`, which is made anew each time and removed at
// the end. Throws what bake::bake throws.
[[nodiscard]] SceneNoise measure_noise(const scene::Scene& scene,
                                       const std::vector<ReferenceLight>& lights,
                                       const BakeReference& reference,
                                       bake::BakeParameters parameters,
                                       std::uint32_t seeds,
                                       const std::filesystem::path& directory);

}  // namespace relume::lab
