// The scenes a server offers: every NAME.relume in one folder.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/wire/scene_summary.h"
#include "server/net/images/sky_pixels.h"
#include "server/net/library/followed_folder.h"
#include "server/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Immutable once made, and independent of the files it was made from: a scene whose directory
// is replaced or removed lives as long as somebody holds it.
struct ServedScene {
    std::string name;
    std::filesystem::path directory;
    std::shared_ptr<const served::Scene> loaded;
    std::shared_ptr<const SkyPixels> sky;  // of the view that all rooms have; null if it moves

    // What clients are told of it.
    [[nodiscard]] wire::SceneSummary summary() const;
};

// Thread-safe.
class SceneLibrary {
  public:
    SceneLibrary();

    static constexpr std::size_t kMaxScenes = 1024;
    static constexpr std::size_t kMaxPictureBytes = std::size_t{4} << 20;

    // Brings the offer up to date with the folder. Opens and checks scenes that are new or have
    // changed, one after another, each on all threads of the caller's arena; drops those that
    // are gone. A scene that cannot be opened is named in the log once; what was offered under
    // its name stays. True if the offer has changed. Throws std::runtime_error if the folder
    // itself cannot be read. Only one thread at a time may refresh; others may ask meanwhile.
    // Once a stop is asked for, it opens no further scene.
    bool refresh(const std::filesystem::path& folder,
                 Patience patience = Patience::none,
                 const std::stop_token& stop = {});

    // By name; null when there is none.
    [[nodiscard]] std::shared_ptr<const ServedScene> find(std::string_view name) const;
    // In the order of their names.
    [[nodiscard]] std::vector<std::shared_ptr<const ServedScene>> list() const;
    // What is expected in the place of a name that there is not: those that are near.
    [[nodiscard]] std::string expected_in_place_of(std::string_view name) const;
    [[nodiscard]] std::uint64_t total_bytes() const;

  private:
    [[nodiscard]] bool follow(const FollowedFolder::Change& change);
    void open(const std::filesystem::path& directory);

    FollowedFolder followed_;  // of who refreshes
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const ServedScene>, std::less<>> scenes_;
};

// Pictures that a bake leaves beside a transport, by their files in view/.
enum class ScenePicture : std::uint8_t {
    thumbnail,  // for lists
    materials   // of kind `curves`: which material each pixel shows
};

inline constexpr text::NameTable<ScenePicture, 2> kScenePictures({{
    {ScenePicture::thumbnail, "thumbnail.png"},
    {ScenePicture::materials, "materials.png"},
}});

// A PNG file; nothing if the bake left none or a too large one.
[[nodiscard]] std::optional<std::string> read_picture(const ServedScene& scene,
                                                      ScenePicture picture);

}  // namespace relume::net
