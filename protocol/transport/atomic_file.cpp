#include "protocol/transport/atomic_file.h"

#include "protocol/transport/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace relume::transport {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int error) {
    throw TransportError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(error)));
}

class Descriptor {
  public:
    Descriptor(const std::filesystem::path& path, int flags)
        : value_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&&) = delete;
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (value_ >= 0) {
            ::close(value_);
        }
    }
    [[nodiscard]] int get() const { return value_; }

  private:
    int value_;
};

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

void write_and_sync(const std::filesystem::path& path, std::initializer_list<Bytes> parts) {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
    if (file.get() < 0) {
        fail(path, "create", errno);
    }
    for (const Bytes part : parts) {
        write_all(path, file.get(), part);
    }
    if (::fsync(file.get()) != 0) {
        fail(path, "sync", errno);
    }
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path,
                           std::initializer_list<Bytes> parts) {
    std::filesystem::path temporary = path;
    temporary += ".tmp";
    try {
        write_and_sync(temporary, parts);
    } catch (...) {
        ::unlink(temporary.c_str());
        throw;
    }
    if (::rename(temporary.c_str(), path.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        fail(path, "rename into place", error);
    }
    const Descriptor folder(path.has_parent_path() ? path.parent_path() : ".",
                            O_RDONLY | O_DIRECTORY);
    if (folder.get() < 0 || ::fsync(folder.get()) != 0) {
        fail(path.parent_path(), "sync", errno);
    }
}

}  // namespace relume::transport
