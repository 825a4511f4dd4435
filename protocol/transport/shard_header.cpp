#include "protocol/transport/shard_header.h"

#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace relume::transport {
namespace {

template <typename Found, typename Expected>
void require(bool holds,
             std::string_view file,
             std::string_view what,
             const Found& found,
             const Expected& expected) {
    if (!holds) {
        throw TransportError(
            fmt::format("{}: header: {} is {}, expected {}", file, what, found, expected));
    }
}

}  // namespace

std::uint64_t ShardHeader::computed_checksum() const {
    const auto all = std::as_bytes(std::span(this, 1));
    return checksum(all.first(offsetof(ShardHeader, header_checksum)));
}

std::size_t ShardHeader::data_offset() const {
    const std::size_t end = kShardHeaderBytes + index_bytes;
    return (end + kShardAlignment - 1) / kShardAlignment * kShardAlignment;
}

ShardHeader parse_shard_header(std::span<const std::byte> bytes, std::string_view file) {
    require(bytes.size() >= kShardHeaderBytes, file, "file length", bytes.size(),
            "at least 128 bytes");
    ShardHeader header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    require(header.magic == kShardMagic, file, "magic", "something else", "RELUMESH");
    require(header.version == kFormatVersion, file, "version", header.version, kFormatVersion);
    require(header.header_checksum == header.computed_checksum(), file, "checksum",
            text_from_checksum(header.computed_checksum()),
            text_from_checksum(header.header_checksum));
    require(std::all_of(header.zero.begin(), header.zero.end(),
                        [](std::uint8_t byte) { return byte == 0; }),
            file, "reserved part", "not zero", "zero");
    require(header.block_count >= 1 && header.block_count <= kMaxBlocksPerShard, file,
            "block count", header.block_count, "1 to 64");
    require(header.channels == 1 || header.channels == kMaxChannels, file, "channel count",
            header.channels, "1 or 3");
    const std::uint64_t segments = std::uint64_t{header.columns} * header.channels;
    require(header.index_bytes == (segments + 1) * sizeof(std::uint32_t), file, "index length",
            header.index_bytes, (segments + 1) * sizeof(std::uint32_t));
    require(header.data_bytes <= std::numeric_limits<std::uint32_t>::max(), file, "data length",
            header.data_bytes, "less than 4 GiB");
    require(header.file_bytes() == bytes.size(), file, "file length", bytes.size(),
            header.file_bytes());
    return header;
}

}  // namespace relume::transport
