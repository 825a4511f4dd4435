// Pictures beside a scene file, as OBJ and PLY name them.
#pragma once

#include "precompute/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace relume::scene {

// A file that `reference` may mean, inside `folder`: as it is written (path_inside), else in
// any mix of upper and lower case, else by the last parts of a path of somebody else's machine.
// Nothing where there is no such file.
[[nodiscard]] std::optional<std::filesystem::path> file_meant(
    const std::filesystem::path& folder, const std::string& reference);

// Decodes each picture once; adds textures to the scene.
class PictureFiles {
  public:
    // The scene must outlive this. No more than `max_textures` are added to it.
    PictureFiles(std::filesystem::path folder, std::uint32_t max_textures, Scene& scene);

    // Null where the picture is not there, which the report names with `user`. Throws
    // SceneError (bad_texture, too_large) for one that cannot be decoded.
    [[nodiscard]] const Texture* picture(const std::string& reference,
                                         TextureContent content,
                                         const std::string& user);
    // Throws SceneError (too_large).
    [[nodiscard]] TextureIndex add(Texture texture);

  private:
    std::filesystem::path folder_;
    std::uint32_t max_textures_;
    Scene& scene_;
    std::map<std::pair<std::string, TextureContent>, std::optional<Texture>> known_;
};

}  // namespace relume::scene
