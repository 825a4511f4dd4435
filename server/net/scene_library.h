// The scenes a server offers: every NAME.relume in one folder.
#pragma once

#include "protocol/wire/scene_summary.h"
#include "server/engine/scene.h"
#include "server/net/sky_pixels.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Immutable once made.
struct ServedScene {
    std::string name;
    std::filesystem::path directory;
    std::shared_ptr<const engine::Scene> engine;
    SkyPixels sky;

    // What clients are told of it.
    [[nodiscard]] wire::SceneSummary summary() const;
};

// Thread-safe.
class SceneLibrary {
  public:
    static constexpr std::size_t kMaxScenes = 1024;
    static constexpr std::size_t kMaxThumbnailBytes = std::size_t{4} << 20;

    // Opens and checks every scene of the folder, one after another, each in parallel within.
    // One that cannot be opened is named in the log and left out. Throws std::runtime_error if
    // the folder itself cannot be read.
    void open_all(const std::filesystem::path& folder);

    // By name; null when there is none.
    [[nodiscard]] std::shared_ptr<const ServedScene> find(std::string_view name) const;
    // In the order of their names.
    [[nodiscard]] std::vector<std::shared_ptr<const ServedScene>> list() const;
    [[nodiscard]] std::uint64_t total_bytes() const;

  private:
    void open(const std::filesystem::path& directory);

    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const ServedScene>, std::less<>> scenes_;
};

// The scene's picture for lists, a PNG file; nothing if the bake left none or a too large one.
[[nodiscard]] std::optional<std::string> read_thumbnail(const ServedScene& scene);

}  // namespace relume::net
