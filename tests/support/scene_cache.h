// Scenes made when they are missing, and kept in a folder.
#pragma once

#include "server/scene/scene.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::test {

// Null when it is not there, or of a format or version that is not today's.
[[nodiscard]] std::shared_ptr<const served::Scene> open_if_whole(
    const std::filesystem::path& directory);

// The folder is not renewed by itself when the baker changes: delete it. A scene that today's
// reader refuses is made again. Not thread-safe.
class SceneCache {
  public:
    // Makes the folder.
    explicit SceneCache(std::filesystem::path folder);

    // NAME.relume in the folder; baked with `arguments` of relume-bake when it is not whole,
    // which is said on standard error. Throws std::runtime_error with what the baker said.
    [[nodiscard]] std::shared_ptr<const served::Scene> baked(
        const std::string& name, const std::vector<std::string>& arguments);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

  private:
    std::filesystem::path folder_;
};

}  // namespace relume::test
