#include "protocol/transport/file_bytes.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace relume::transport {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action) {
    throw TransportError(
        fmt::format("{}: cannot {}: {}", path.string(), action, std::strerror(errno)));
}

// Reads until the span is full; the file may have been cut meanwhile.
void read_whole(const std::filesystem::path& path, int descriptor, std::span<std::byte> into) {
    std::size_t at = 0;
    while (at < into.size()) {
        const ssize_t count =
            ::pread(descriptor, into.data() + at, into.size() - at, static_cast<off_t>(at));
        if (count < 0 && errno != EINTR) {
            fail(path, "read");
        }
        if (count == 0) {
            throw TransportError(fmt::format("{}: ends after {} bytes, expected {}",
                                             path.string(), at, into.size()));
        }
        at += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

std::span<const std::byte> map_descriptor(const std::filesystem::path& path, int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) {
        fail(path, "look at");
    }
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) {
        return {};
    }
    void* address =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (address == MAP_FAILED) {
        fail(path, "find memory for");
    }
    // Columns are read here and there: fewer pages, fewer misses.
    ::madvise(address, size, MADV_HUGEPAGE);
    const std::span<std::byte> bytes{static_cast<std::byte*>(address), size};
    try {
        read_whole(path, descriptor, bytes);
    } catch (...) {
        ::munmap(address, size);
        throw;
    }
    ::mprotect(address, size, PROT_READ);
    return bytes;
}

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path) {
    try {
        const files::Descriptor file = files::open_regular_file(path);
        bytes_ = map_descriptor(path, file.get());
    } catch (const files::FileError& error) {
        throw TransportError(error.what());
    }
}

FileBytes::FileBytes(FileBytes&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

FileBytes::~FileBytes() {
    if (!bytes_.empty()) {
        ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
    }
}

}  // namespace relume::transport
