// The first 128 bytes of a shard file (protocol/README.md §2).
#pragma once

#include "protocol/transport/format.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace relume::transport {

struct ShardHeader {
    std::array<std::uint8_t, 8> magic = kShardMagic;
    std::uint32_t version = kFormatVersion;
    std::uint32_t number = 0;
    std::uint32_t first_block = 0;
    std::uint32_t block_count = 0;
    std::uint32_t columns = 0;
    std::uint32_t channels = 0;
    std::uint64_t index_bytes = 0;
    std::uint64_t index_checksum = 0;
    std::uint64_t data_bytes = 0;
    std::uint64_t data_checksum = 0;
    std::uint64_t fingerprint = 0;
    std::array<std::uint8_t, 48> zero{};
    std::uint64_t header_checksum = 0;

    [[nodiscard]] std::uint64_t computed_checksum() const;
    [[nodiscard]] std::size_t data_offset() const;
    [[nodiscard]] std::size_t file_bytes() const {
        return data_offset() + data_bytes + kShardTailBytes;
    }
};
static_assert(sizeof(ShardHeader) == kShardHeaderBytes);

// Reads and checks everything the header alone can tell, and that the file is as long as it
// says. `file` names the shard in the error.
[[nodiscard]] ShardHeader parse_shard_header(std::span<const std::byte> bytes,
                                             std::string_view file);

}  // namespace relume::transport
