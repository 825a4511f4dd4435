#include "protocol/base/files/disk_room.h"

#include "protocol/base/files/descriptor.h"
#include "protocol/base/files/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace relume::files {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int error) {
    throw FileError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

void try_to_write(const std::filesystem::path& directory) {
    const std::filesystem::path probe = directory / fmt::format(".room-{}.tmp", ::getpid());
    const Descriptor file(::open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (!file.is_open()) {
        fail(directory, "write into it", errno);
    }
    constexpr std::array<char, 4096> kBlock{};
    const ssize_t written = ::write(file.get(), kBlock.data(), kBlock.size());
    const int error = written < 0 ? errno : ENOSPC;
    ::unlink(probe.c_str());
    if (written != static_cast<ssize_t>(kBlock.size())) {
        fail(directory, "write into it", error);
    }
}

}  // namespace

void make_file_size_limit_an_error() {
    std::signal(SIGXFSZ, SIG_IGN);
}

void require_room(const std::filesystem::path& directory,
                  std::uint64_t total_bytes,
                  std::uint64_t longest_bytes) {
    try_to_write(directory);
    struct statvfs room {};
    if (::statvfs(directory.c_str(), &room) == 0) {
        const std::uint64_t free = std::uint64_t{room.f_bavail} * room.f_frsize;
        if (free < total_bytes) {
            throw FileError(fmt::format(
                "{}: found {:.1f} MB free on the disk, expected room for at least {:.1f} MB",
                directory.string(), static_cast<double>(free) / 1e6,
                static_cast<double>(total_bytes) / 1e6));
        }
    }
    struct rlimit limit {};
    if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        limit.rlim_cur < longest_bytes) {
        throw FileError(fmt::format(
            "{}: found a limit of {} bytes a file (ulimit -f), expected at least {}",
            directory.string(), limit.rlim_cur, longest_bytes));
    }
}

void require_replaceable(const std::filesystem::path& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
        throw FileError(
            fmt::format("{}: found a directory, expected a file or nothing", path.string()));
    }
}

}  // namespace relume::files
