#include "server/net/library/followed_folder.h"

#include "protocol/transport/checksum.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

// A transport has shards/ and view/, of some 16384 files at most.
constexpr int kLevels = 3;
constexpr std::size_t kMaxEntries = 65536;

std::uint64_t stamp_of_status(const struct stat& status, const std::string& path) {
    const std::array<std::uint64_t, 6> facts{
        status.st_dev,
        status.st_ino,
        static_cast<std::uint64_t>(status.st_size),
        static_cast<std::uint64_t>(status.st_mtim.tv_sec),
        static_cast<std::uint64_t>(status.st_mtim.tv_nsec),
        transport::checksum(std::as_bytes(std::span(path)))};
    return transport::checksum(std::as_bytes(std::span(facts)));
}

std::uint64_t stamp_of_entries(const fs::path& directory) {
    std::uint64_t stamp = 0;
    std::error_code error;
    std::size_t entries = 0;
    fs::recursive_directory_iterator entry(
        directory, fs::directory_options::skip_permission_denied, error);
    for (const fs::recursive_directory_iterator end;
         !error && entry != end && entries < kMaxEntries; entry.increment(error)) {
        struct stat status {};
        const std::string path = entry->path().string();
        if (::lstat(path.c_str(), &status) == 0) {
            // A sum: the order of a listing is nobody's promise.
            stamp += stamp_of_status(status, path);
        }
        ++entries;
        if (entry.depth() + 1 >= kLevels) {
            entry.disable_recursion_pending();
        }
    }
    return stamp;
}

}  // namespace

std::uint64_t stamp_of(const fs::path& entry) {
    struct stat status {};
    if (::stat(entry.c_str(), &status) != 0) {
        return 0;
    }
    std::uint64_t stamp = stamp_of_status(status, entry.string());
    if (S_ISDIR(status.st_mode)) {
        stamp += stamp_of_entries(entry);
    }
    return std::max<std::uint64_t>(1, stamp);
}

std::vector<FollowedFolder::Change> FollowedFolder::look(const fs::path& folder,
                                                         Patience patience) {
    std::error_code error;
    std::vector<fs::path> there;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (concerns_(*entry)) {
            there.push_back(entry->path());
        }
    }
    if (error) {
        throw std::runtime_error(
            fmt::format("cannot list {}: {}", folder.string(), error.message()));
    }
    std::sort(there.begin(), there.end());
    too_many_ = there.size() > most_ ? there.size() : 0;
    there.resize(std::min(there.size(), most_));
    for (const fs::path& entry : there) {
        seen_.try_emplace(entry);
    }
    std::vector<Change> changes;
    for (auto it = seen_.begin(); it != seen_.end();) {
        auto& [entry, seen] = *it;
        const bool is_there = std::binary_search(there.begin(), there.end(), entry);
        const std::uint64_t stamp = is_there ? stamp_of(entry) : 0;
        const bool has_settled = patience == Patience::none || stamp == seen.stamp;
        seen.stamp = stamp;
        if (has_settled && stamp != seen.followed_stamp) {
            seen.followed_stamp = stamp;
            changes.push_back({.entry = entry, .is_gone = stamp == 0});
        }
        it = seen.stamp == 0 && seen.followed_stamp == 0 ? seen_.erase(it) : std::next(it);
    }
    return changes;
}

std::vector<fs::path> FollowedFolder::entries() const {
    std::vector<fs::path> all;
    for (const auto& [entry, seen] : seen_) {
        if (seen.stamp != 0) {
            all.push_back(entry);
        }
    }
    return all;
}

}  // namespace relume::net
