#include "protocol/transport/mapped_file.h"

#include "base/files/error.h"
#include "base/files/regular_file.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

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
        fail(path, "look at");
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
    try {
        const files::Descriptor file = files::open_regular_file(path);
        bytes_ = map_descriptor(path, file.get());
    } catch (const files::FileError& error) {
        throw TransportError(error.what());
    }
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
