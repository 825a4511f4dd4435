// The page: a folder of files read once, at start.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace relume::net {

struct StaticFile {
    std::shared_ptr<const std::string> body;
    std::string content_type;
    std::string entity_tag;  // quoted, of the content
    std::string cache_control;
};

// Immutable. All files are in memory and a request is looked up among them by its whole path:
// no request ever reaches the file system, so none can leave the folder.
class StaticFiles {
  public:
    static constexpr std::size_t kMaxFiles = 4096;
    static constexpr std::size_t kMaxTotalBytes = std::size_t{64} << 20;

    // No page: a short text in its place.
    StaticFiles();
    // Every regular file below the folder; links to elsewhere are left out. Throws
    // std::runtime_error if it cannot be read, has no index.html, or passes the bounds above.
    explicit StaticFiles(const std::filesystem::path& folder);

    // `path` begins with '/', decoded. A path that names no file and has no extension is a
    // place within the page, and gets index.html. Null when there is no such file.
    [[nodiscard]] const StaticFile* find(std::string_view path) const;

  private:
    std::map<std::string, StaticFile, std::less<>> files_;  // by path, "/index.html"
};

}  // namespace relume::net
