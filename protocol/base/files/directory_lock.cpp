#include "protocol/base/files/directory_lock.h"

#include "protocol/base/files/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>

namespace relume::files {

DirectoryLock::DirectoryLock(const std::filesystem::path& directory)
    : directory_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (!directory_.is_open()) {
        throw FileError(
            fmt::format("{}: cannot open: {}", directory.string(), std::strerror(errno)));
    }
    if (::flock(directory_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        throw FileError(fmt::format(
            "{}: found another process writing into it, expected to be the only one; wait for "
            "it, or choose another name",
            directory.string()));
    }
}

}  // namespace relume::files
