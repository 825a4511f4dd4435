#include "precompute/scene/gltf/container.h"

#include "precompute/scene/shown_text.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"

#include <fmt/format.h>

#include <limits>
#include <system_error>

namespace relume::scene::gltf {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

std::uint32_t little_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{bytes[at + i]} << (8 * i);
    return value;
}

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string read_file(const std::filesystem::path& path,
                      std::uint64_t max_bytes,
                      const FileName& file) {
    const std::string shown = shown_text(path.string());
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!error && size > max_bytes)
        file.refuse(SceneFault::too_large, fmt::format("'{}' has {} bytes; expected at most {}",
                                                       shown, size, max_bytes));
    try {
        return files::read_regular_file(path, static_cast<std::size_t>(max_bytes));
    } catch (const files::FileError& fault) {
        file.refuse(SceneFault::missing_file, shown_text(fault.what()));
    }
}

Container::Container(const std::filesystem::path& path, const FileName& file)
    : bytes_(read_file(path, std::numeric_limits<std::uint64_t>::max(), file)) {
    const auto all = bytes_of(bytes_);
    if (text_of(all).substr(0, 4) != "glTF") {
        json_ = text_of(all);
        return;
    }
    const auto refuse = [&](const std::string& why) {
        file.refuse(SceneFault::corrupt_file, "GLB: " + why);
    };
    if (all.size() < kHeaderBytes)
        refuse(fmt::format("{} bytes; expected a header of {}", all.size(), kHeaderBytes));
    if (const std::uint32_t version = little_endian(all, 4); version != 2)
        refuse(fmt::format("version {}; expected 2", version));
    const std::uint32_t length = little_endian(all, 8);
    if (length > all.size())
        refuse(fmt::format("its header says {} bytes, the file has {}: cut short", length,
                           all.size()));
    std::size_t at = kHeaderBytes;
    // Chunks of other kinds are to be passed over.
    while (length >= at + kChunkHeaderBytes) {
        const std::uint32_t size = little_endian(all, at);
        const std::uint32_t kind = little_endian(all, at + 4);
        at += kChunkHeaderBytes;
        if (size > length - at)
            refuse(fmt::format("a chunk of {} bytes at {}; expected at most {}", size, at,
                               length - at));
        if (kind == kJsonChunk && json_.empty())
            json_ = text_of(all.subspan(at, size));
        else if (kind == kBinaryChunk && !binary_)
            binary_ = all.subspan(at, size);
        at += (std::size_t{size} + 3) / 4 * 4;
    }
    if (json_.empty())
        refuse("no JSON chunk; expected one");
}

}  // namespace relume::scene::gltf
