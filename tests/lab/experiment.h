// Runs methods over a lighting sequence on one scene and measures every image.
#pragma once

#include "server/engine/scene.h"
#include "tests/lab/lighting_sequence.h"
#include "tests/lab/method.h"
#include "tests/lab/record_table.h"

#include <functional>
#include <memory>
#include <vector>

namespace relume::lab {

// Every image is given its light anew and one step, as in the papers: also at rest NWA-k stays
// at k terms, and nothing but the method's own increments improves the image. The reference of
// each image is the dense product of the stored transport. `progress` is called after each
// image with its number. Errors are reproducible to the last digit; times are not.
[[nodiscard]] std::vector<Record> run_experiment(
    const std::shared_ptr<const engine::Scene>& scene,
    const LightingSequence& sequence,
    const std::vector<Method>& methods,
    const std::function<void(std::uint32_t)>& progress);

}  // namespace relume::lab
