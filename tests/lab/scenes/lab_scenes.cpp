#include "tests/lab/scenes/lab_scenes.h"

#include <fmt/format.h>

namespace relume::lab {

namespace {

std::vector<std::string> arguments(const std::string& name, std::uint32_t side) {
    return {"--builtin",          name, "--size",    fmt::format("{0}x{0}", side),
            "--light-resolution", "32", "--bounces", "1",
            "--samples",          "16"};
}

std::vector<std::string> arguments(const LabSurface& surface) {
    return {"--builtin",
            surface.scene,
            "--receivers",
            "vertices",
            "--vertices",
            std::to_string(surface.vertices),
            "--terms",
            std::to_string(surface.terms),
            "--light-resolution",
            "32",
            "--bounces",
            "2",
            "--size",
            fmt::format("{0}x{0}", surface.side),
            "--target-error",
            "0.001"};
}

std::string name_of(const LabSurface& surface) {
    return fmt::format("mesh-{}-{}-{}-{}", surface.scene, surface.vertices, surface.terms,
                       surface.side);
}

std::vector<std::string> in_spherical_harmonics(std::vector<std::string> words) {
    words.insert(words.end(), {"--basis", "sh", "--order", "20"});
    return words;
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
    return scenes_
        .baked(fmt::format("{}-{}-sh20", name, side),
               in_spherical_harmonics(arguments(name, side)))
        ->transport()
        .directory();
}

std::shared_ptr<const served::Scene> LabScenes::surface(const LabSurface& surface) {
    return scenes_.baked(name_of(surface), arguments(surface));
}

std::filesystem::path LabScenes::sh_transport(const LabSurface& surface) {
    return scenes_
        .baked(name_of(surface) + "-sh20", in_spherical_harmonics(arguments(surface)))
        ->transport()
        .directory();
}

}  // namespace relume::lab
