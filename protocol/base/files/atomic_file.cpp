#include "protocol/base/files/atomic_file.h"

#include "protocol/base/files/descriptor.h"
#include "protocol/base/files/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace relume::files {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int error) {
    throw FileError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

struct TemporaryFile {
    std::filesystem::path path;
    Descriptor descriptor;
};

// NAME.tmp, made anew; NAME.tmp1 … where a folder, or a file that may not be removed, has that
// name.
TemporaryFile make_temporary(const std::filesystem::path& path) {
    constexpr int kNames = 10;
    int error = 0;
    for (int i = 0; i < kNames; ++i) {
        TemporaryFile temporary{.path = path, .descriptor = {}};
        temporary.path += i == 0 ? std::string(".tmp") : fmt::format(".tmp{}", i);
        ::unlink(temporary.path.c_str());
        temporary.descriptor = Descriptor(
            ::open(temporary.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
        if (temporary.descriptor.is_open()) {
            return temporary;
        }
        error = errno;
        if (error != EEXIST) {
            break;
        }
    }
    fail(path, "create", error);
}

void write_all(const std::filesystem::path& path, int descriptor, Bytes bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0) {
            if (errno == EINTR) {
                continue;
            }
            fail(path, "write", errno);
        }
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const Bytes> parts) {
    const TemporaryFile temporary = make_temporary(path);
    try {
        for (const Bytes part : parts) {
            write_all(path, temporary.descriptor.get(), part);
        }
        if (::fsync(temporary.descriptor.get()) != 0) {
            fail(path, "sync", errno);
        }
        if (::rename(temporary.path.c_str(), path.c_str()) != 0) {
            fail(path, "rename into place", errno);
        }
    } catch (...) {
        ::unlink(temporary.path.c_str());
        throw;
    }
    const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : ".";
    const Descriptor folder(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // Some file systems cannot sync a folder and say EINVAL; what they hold is safe by then.
    if (!folder.is_open() || (::fsync(folder.get()) != 0 && errno != EINVAL)) {
        fail(parent, "sync", errno);
    }
}

}  // namespace relume::files
