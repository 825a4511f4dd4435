#include "protocol/base/files/regular_file.h"

#include "protocol/base/files/error.h"
#include "protocol/base/text/near_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace relume::files {
namespace {

std::string_view kind_of(mode_t mode) {
    if (S_ISDIR(mode)) {
        return "a directory";
    }
    if (S_ISFIFO(mode)) {
        return "a named pipe";
    }
    if (S_ISSOCK(mode)) {
        return "a socket";
    }
    if (S_ISLNK(mode)) {
        return "a symbolic link";
    }
    return S_ISCHR(mode) || S_ISBLK(mode) ? "a device" : "something else";
}

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
    throw FileError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

void require_regular(const std::filesystem::path& path, mode_t mode) {
    if (!S_ISREG(mode)) {
        throw FileError(
            fmt::format("{}: found {}, expected a regular file", path.string(), kind_of(mode)));
    }
}

}  // namespace

Descriptor open_regular_file(const std::filesystem::path& path, Links links) {
    // Looked at before it is opened, for opening a device may do something; and again after,
    // for it may have been replaced between.
    struct stat status {};
    const int looked =
        links == Links::follow ? ::stat(path.c_str(), &status) : ::lstat(path.c_str(), &status);
    if (looked != 0 && errno == ENOENT) {
        throw FileError(
            fmt::format("{}: {}", path.string(), text::text_from_missing_file(path)));
    }
    if (looked != 0) {
        fail(path, "open");
    }
    require_regular(path, status.st_mode);
    const int no_follow = links == Links::follow ? 0 : O_NOFOLLOW;
    Descriptor descriptor(
        ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | no_follow));
    if (!descriptor.is_open()) {
        fail(path, "open");
    }
    if (::fstat(descriptor.get(), &status) != 0) {
        fail(path, "look at");
    }
    require_regular(path, status.st_mode);
    return descriptor;
}

void require_regular_file(const std::filesystem::path& path) {
    static_cast<void>(open_regular_file(path));
}

std::string read_beginning(const std::filesystem::path& path,
                           std::size_t most_bytes,
                           Links links) {
    const Descriptor file = open_regular_file(path, links);
    constexpr std::size_t kChunk = std::size_t{64} << 10;
    std::string bytes;
    while (bytes.size() < most_bytes) {
        const std::size_t filled = bytes.size();
        bytes.resize(filled + std::min(kChunk, most_bytes - filled));
        const ssize_t count = ::read(file.get(), bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno != EINTR) {
            fail(path, "read");
        }
        bytes.resize(filled + static_cast<std::size_t>(count > 0 ? count : 0));
        if (count == 0) {
            break;
        }
    }
    return bytes;
}

std::string read_regular_file(const std::filesystem::path& path,
                              std::size_t max_bytes,
                              Links links) {
    // One byte more shows that there are more; nothing is longer than the largest number.
    const std::size_t most = std::max(max_bytes, max_bytes + 1);
    std::string bytes = read_beginning(path, most, links);
    if (bytes.size() > max_bytes) {
        throw FileError(fmt::format("{}: found more than {} bytes, expected at most that",
                                    path.string(), max_bytes));
    }
    return bytes;
}

}  // namespace relume::files
