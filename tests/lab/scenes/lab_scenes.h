// The built-in scenes as the lab bakes them.
#pragma once

#include "tests/support/scene_cache.h"

#include <filesystem>
#include <memory>
#include <string>

namespace relume::lab {

// Beside the program.
[[nodiscard]] std::string default_scene_cache();

// A built-in scene's surface: 6×32×32, two bounces, target error 0.1 %.
struct LabSurface {
    std::string scene = "street";
    std::uint32_t vertices = 40'000;  // at most
    std::uint32_t terms = 4;          // of every glossy material
    std::uint32_t side = 512;         // of the images that its views begin with, in pixels
};

// What the vertices of a surface see of the light, for triple products; rows of light are as
// coarse as may be.
struct LabVisibility {
    std::string scene = "table";  // built in, or a file that relume-bake reads
    std::uint32_t vertices = 80'000;
    std::uint32_t face_resolution = 64;
};

// Built-in scenes of relume-bake, baked once into a cache: one bounce, 16 samples, 6×32×32.
class LabScenes {
  public:
    explicit LabScenes(const std::string& cache) : scenes_(cache) {}

    // Square. Throws as test::SceneCache does.
    [[nodiscard]] std::shared_ptr<const served::Scene> scene(const std::string& name,
                                                             std::uint32_t side = 128);

    // The folder of the same view in spherical harmonics of order 20.
    [[nodiscard]] std::filesystem::path sh_transport(const std::string& name,
                                                     std::uint32_t side = 128);

    [[nodiscard]] std::shared_ptr<const served::Scene> surface(const LabSurface& surface);
    // Refined as far as there may be vertices.
    [[nodiscard]] std::shared_ptr<const served::Scene> visibility(
        const LabVisibility& visibility);
    // The folder of the same surface in spherical harmonics of order 20.
    [[nodiscard]] std::filesystem::path sh_transport(const LabSurface& surface);

  private:
    test::SceneCache scenes_;
};

}  // namespace relume::lab
