// What the bake says a picture is, over several seeds: with the spread between them as the
// measure of its own noise.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/scene/scene.h"
#include "tests/support/dense_product.h"

#include <Imath/ImathVec.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace relume::test {

struct Estimate {
    std::vector<Imath::V3d> mean;
    std::vector<Imath::V3d> variance;  // of the mean
    std::uint32_t seeds = 0;
};

// Every approximation of the bake that is a choice turned off: one ray per pixel, no paths from
// neighbours, no shrinkage. What is left has to be unbiased.
[[nodiscard]] bake::BakeParameters unbiased_parameters();

// The picture of one bake before it is quantised and stored: its float rows times the light.
[[nodiscard]] LinearImage relit_from_rows(const scene::Scene& scene,
                                          const bake::BakeParameters& parameters,
                                          const std::vector<Imath::V3f>& light);
// The same bake, stored in `directory` and read back.
[[nodiscard]] LinearImage relit_from_stored(const scene::Scene& scene,
                                            const bake::BakeParameters& parameters,
                                            const std::vector<Imath::V3f>& light,
                                            const std::filesystem::path& directory);

// Rows of `seeds` bakes.
[[nodiscard]] Estimate estimate_from_rows(const scene::Scene& scene,
                                          bake::BakeParameters parameters,
                                          const std::vector<Imath::V3f>& light,
                                          std::uint32_t seeds);

[[nodiscard]] double relative_l2(const std::vector<Imath::V3d>& image,
                                 const std::vector<Imath::V3d>& truth);

}  // namespace relume::test
