// Gathers the encoded blocks of one shard and writes them column by column.
#pragma once

#include "protocol/transport/cell.h"
#include "protocol/transport/shard_header.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace relume::transport {

// All columns of one block, encoded in the order j·K + k. Holds a few per cent of the block's
// dense size.
class EncodedBlock {
  public:
    explicit EncodedBlock(std::size_t segment_count);

    // Appends the next column's cell.
    void append(const QuantisedCell& values);
    // … in this encoding, which fits it.
    void append_as(CellTag tag, const QuantisedCell& values);
    [[nodiscard]] bool complete() const { return tags_.size() == segment_count_; }
    [[nodiscard]] std::size_t segment_count() const { return segment_count_; }

    [[nodiscard]] CellTag tag(std::size_t segment) const { return tags_[segment]; }
    [[nodiscard]] std::span<const std::uint8_t> cell(std::size_t segment) const {
        return std::span(bytes_).subspan(offsets_[segment],
                                         offsets_[segment + 1] - offsets_[segment]);
    }

  private:
    std::size_t segment_count_;
    std::vector<CellTag> tags_;
    std::vector<std::size_t> offsets_;
    std::vector<std::uint8_t> bytes_;
};

struct ShardIdentity {
    std::uint32_t number = 0;
    std::uint32_t first_block = 0;
    std::uint32_t columns = 0;
    std::uint32_t channels = 0;
    std::uint64_t fingerprint = 0;
};

// `blocks` are consecutive from first_block, each complete. Throws TransportError when the data
// would pass 4 GiB or the file cannot be written. Returns the header written.
ShardHeader write_shard(const std::filesystem::path& path,
                        const ShardIdentity& identity,
                        const std::vector<EncodedBlock>& blocks);

}  // namespace relume::transport
