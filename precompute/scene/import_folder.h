// Files beside a scene: what it refers to by name is looked for in its own folder and below.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace relume::scene {

// `reference` as written in a scene file (slashes of either kind, percent escapes) as a path
// inside `folder`, or nothing where it leads out of it. Symbolic links are not followed here:
// they are the user's own.
[[nodiscard]] std::optional<std::filesystem::path> path_inside(
    const std::filesystem::path& folder, const std::string& reference);

// `%` and two hexadecimal digits stand for a byte; anything else stands for itself.
[[nodiscard]] std::string percent_decoded(const std::string& text);

// Lets assimp open the scene and files inside its folder, none longer than the limit.
class FolderIo : public Assimp::DefaultIOSystem {
  public:
    FolderIo(std::filesystem::path folder, std::uint64_t max_file_bytes)
        : folder_(std::move(folder)), max_file_bytes_(max_file_bytes) {}
    [[nodiscard]] bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    // Files asked for that are not there, are too long, or lie outside the folder.
    [[nodiscard]] const std::set<std::string>& refused() const { return refused_; }

  private:
    [[nodiscard]] bool is_allowed(const char* file) const;

    std::filesystem::path folder_;
    std::uint64_t max_file_bytes_;
    std::set<std::string> refused_;
};

}  // namespace relume::scene
