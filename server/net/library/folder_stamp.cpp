#include "server/net/library/folder_stamp.h"

#include "protocol/transport/checksum.h"

#include <sys/stat.h>

#include <array>
#include <string>
#include <system_error>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

// A transport has shards/ and view/, of some 16384 files at most.
constexpr int kLevels = 3;
constexpr std::size_t kMaxEntries = 65536;

std::uint64_t stamp_of_entry(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0) {
        return 0;
    }
    const std::array<std::uint64_t, 6> facts{
        status.st_dev,
        status.st_ino,
        static_cast<std::uint64_t>(status.st_size),
        static_cast<std::uint64_t>(status.st_mtim.tv_sec),
        static_cast<std::uint64_t>(status.st_mtim.tv_nsec),
        transport::checksum(std::as_bytes(std::span(path)))};
    return transport::checksum(std::as_bytes(std::span(facts)));
}

}  // namespace

std::uint64_t folder_stamp(const fs::path& directory) {
    std::error_code error;
    if (!fs::is_directory(directory, error)) {
        return 0;
    }
    std::uint64_t stamp = stamp_of_entry(directory.string());
    std::size_t entries = 0;
    fs::recursive_directory_iterator entry(
        directory, fs::directory_options::skip_permission_denied, error);
    for (const fs::recursive_directory_iterator end;
         !error && entry != end && entries < kMaxEntries; entry.increment(error)) {
        // A sum: the order of a listing is nobody's promise.
        stamp += stamp_of_entry(entry->path().string());
        ++entries;
        if (entry.depth() + 1 >= kLevels) {
            entry.disable_recursion_pending();
        }
    }
    return stamp == 0 ? 1 : stamp;
}

}  // namespace relume::net
