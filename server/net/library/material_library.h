// The materials that a server offers for parts of scenes: every .material of one folder.
#pragma once

#include "server/net/library/followed_folder.h"
#include "server/net/library/material_family.h"
#include "server/net/library/resident_cache.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace relume::net {

// Thread-safe, but that one thread at a time may refresh.
class MaterialLibrary {
  public:
    static constexpr std::size_t kMostFiles = 1024;
    using SharedFamily = std::shared_ptr<const MaterialFamily>;

    // Materials in texels that nobody uses are kept up to so many bytes.
    explicit MaterialLibrary(std::size_t cache_bytes);

    // Brings the offer up to date with the folder. Reads and checks files that are new or have
    // changed. One that cannot be used, or that does not go with the others of its family, is
    // named in the log once and left out. Throws std::runtime_error if the folder cannot be
    // read.
    void refresh(const std::filesystem::path& folder, Patience patience = Patience::none);

    // By name, of the face resolution that is asked for; null when there is none. Rooms keep
    // what they have found, whatever becomes of the folder.
    [[nodiscard]] SharedFamily find(std::string_view name, std::uint32_t face_resolution) const;
    // In the order of their names.
    [[nodiscard]] std::vector<SharedFamily> list() const;
    // Bytes that are kept in texels, but for those that only rooms hold.
    [[nodiscard]] std::size_t resident_bytes() const { return cache_->bytes(); }

  private:
    using Files = std::map<std::filesystem::path, std::shared_ptr<TabulatedMaterial>>;

    [[nodiscard]] std::vector<SharedFamily> families() const;

    const std::shared_ptr<ResidentCache> cache_;
    // Of who refreshes:
    FollowedFolder followed_;
    Files files_;

    mutable std::mutex mutex_;
    std::vector<SharedFamily> offered_;  // in the order of their names
};

}  // namespace relume::net
