#include "tests/lab/scenes/lab_scenes.h"

#include <fmt/format.h>

namespace relume::lab {

namespace {

std::vector<std::string> arguments(const std::string& name, std::uint32_t side) {
    return {"--builtin",          name, "--size",    fmt::format("{0}x{0}", side),
            "--light-resolution", "32", "--bounces", "1",
            "--samples",          "16"};
}

}  // namespace

std::string default_scene_cache() {
    return RELUME_LAB_CACHE;
}

std::shared_ptr<const served::Scene> LabScenes::scene(const std::string& name,
                                                      std::uint32_t side) {
    return scenes_.baked(fmt::format("{}-{}-32", name, side), arguments(name, side));
}

std::filesystem::path LabScenes::sh_transport(const std::string& name, std::uint32_t side) {
    std::vector<std::string> words = arguments(name, side);
    words.insert(words.end(), {"--basis", "sh", "--order", "20"});
    return scenes_.baked(fmt::format("{}-{}-sh20", name, side), words)->transport().directory();
}

}  // namespace relume::lab
