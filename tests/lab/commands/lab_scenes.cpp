#include "tests/lab/commands/lab_scenes.h"

#include <fmt/format.h>

namespace relume::lab {

std::string default_scene_cache() {
    return RELUME_LAB_CACHE;
}

std::shared_ptr<const engine::Scene> LabScenes::scene(const std::string& name,
                                                      std::uint32_t side) {
    return scenes_.baked(fmt::format("{}-{}-32", name, side),
                         {"--builtin", name, "--size", fmt::format("{0}x{0}", side),
                          "--light-resolution", "32", "--bounces", "1", "--samples", "16"});
}

}  // namespace relume::lab
