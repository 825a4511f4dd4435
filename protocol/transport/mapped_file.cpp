#include "protocol/transport/mapped_file.h"

#include "protocol/transport/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace relume::transport {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
    throw TransportError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

std::span<const std::byte> map_descriptor(const std::filesystem::path& path, int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) {
        fail(path, "stat");
    }
    if (!S_ISREG(status.st_mode)) {
        throw TransportError(fmt::format("{}: expected a regular file", path.string()));
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) {
        return {};
    }
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
    if (address == MAP_FAILED) {
        fail(path, "map");
    }
    ::madvise(address, size, MADV_WILLNEED);
    return {static_cast<const std::byte*>(address), size};
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        fail(path, "open");
    }
    try {
        bytes_ = map_descriptor(path, descriptor);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    ::close(descriptor);
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) {
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    }
}

}  // namespace relume::transport
