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

bool is_file(const std::string& scene) {
    return std::filesystem::path(scene).has_extension();
}

std::vector<std::string> arguments(const LabVisibility& visibility) {
    std::vector<std::string> words{"--receivers",
                                   "vertices",
                                   "--fields",
                                   "--vertices",
                                   std::to_string(visibility.vertices),
                                   "--visibility-resolution",
                                   std::to_string(visibility.face_resolution),
                                   "--light-resolution",
                                   "4",
                                   "--terms",
                                   "1",
                                   "--bounces",
                                   "0",
                                   "--target-error",
                                   "0.000001"};
    if (is_file(visibility.scene)) {
        words.insert(words.begin(), std::filesystem::absolute(visibility.scene).string());
    } else {
        words.insert(words.begin(), {"--builtin", visibility.scene});
    }
    return words;
}

std::string name_of(const LabVisibility& visibility) {
    return fmt::format("seen-{}-{}-{}", std::filesystem::path(visibility.scene).stem().string(),
                       visibility.vertices, visibility.face_resolution);
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

std::shared_ptr<const served::Scene> LabScenes::visibility(const LabVisibility& visibility) {
    return scenes_.baked(name_of(visibility), arguments(visibility));
}

std::filesystem::path LabScenes::sh_transport(const LabSurface& surface) {
    return scenes_
        .baked(name_of(surface) + "-sh20", in_spherical_harmonics(arguments(surface)))
        ->transport()
        .directory();
}

}  // namespace relume::lab
