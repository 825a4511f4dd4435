#include "protocol/transport/shard_writer.h"

#include "protocol/base/files/atomic_file.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace relume::transport {
namespace {

void append_segment(const std::vector<EncodedBlock>& blocks,
                    std::size_t segment,
                    std::vector<std::uint8_t>& data) {
    const bool empty = std::all_of(
        blocks.begin(), blocks.end(),
        [&](const EncodedBlock& block) { return block.tag(segment) == CellTag::empty; });
    if (empty) {
        return;
    }
    for (std::size_t block = 0; block < blocks.size(); block += 2) {
        const auto low = static_cast<unsigned>(blocks[block].tag(segment));
        const auto high = block + 1 < blocks.size()
                              ? static_cast<unsigned>(blocks[block + 1].tag(segment))
                              : 0U;
        data.push_back(static_cast<std::uint8_t>(low | (high << 4U)));
    }
    for (const EncodedBlock& block : blocks) {
        const auto cell = block.cell(segment);
        data.insert(data.end(), cell.begin(), cell.end());
    }
}

}  // namespace

EncodedBlock::EncodedBlock(std::size_t segment_count) : segment_count_(segment_count) {
    tags_.reserve(segment_count);
    offsets_.reserve(segment_count + 1);
    offsets_.push_back(0);
}

void EncodedBlock::append(const QuantisedCell& values) {
    tags_.push_back(append_cell(values, bytes_));
    offsets_.push_back(bytes_.size());
}

void EncodedBlock::append_as(CellTag tag, const QuantisedCell& values) {
    tags_.push_back(tag);
    append_cell_as(tag, values, bytes_);
    offsets_.push_back(bytes_.size());
}

ShardHeader write_shard(const std::filesystem::path& path,
                        const ShardIdentity& identity,
                        const std::vector<EncodedBlock>& blocks) {
    const std::size_t segments = std::size_t{identity.columns} * identity.channels;
    for (const EncodedBlock& block : blocks) {
        if (!block.complete() || block.segment_count() != segments) {
            throw TransportError(fmt::format("{}: a block holds {} segments, expected {}",
                                             path.string(), block.segment_count(), segments));
        }
    }
    std::vector<std::uint32_t> index;
    index.reserve(segments + 1);
    index.push_back(0);
    std::vector<std::uint8_t> data;
    for (std::size_t segment = 0; segment < segments; ++segment) {
        append_segment(blocks, segment, data);
        if (data.size() > std::numeric_limits<std::uint32_t>::max()) {
            throw TransportError(fmt::format(
                "{}: data passes 4 GiB; use fewer blocks per shard", path.string()));
        }
        index.push_back(static_cast<std::uint32_t>(data.size()));
    }
    ShardHeader header;
    header.number = identity.number;
    header.first_block = identity.first_block;
    header.block_count = static_cast<std::uint32_t>(blocks.size());
    header.columns = identity.columns;
    header.channels = identity.channels;
    header.fingerprint = identity.fingerprint;
    header.index_bytes = index.size() * sizeof(std::uint32_t);
    header.index_checksum = checksum(files::bytes_of(index));
    header.data_bytes = data.size();
    header.data_checksum = checksum(files::bytes_of(data));
    header.header_checksum = header.computed_checksum();
    const std::vector<std::byte> padding(header.data_offset() - kShardHeaderBytes -
                                         header.index_bytes);
    constexpr std::array<std::byte, kShardTailBytes> tail{};
    files::write_file_atomically(
        path, {std::as_bytes(std::span(&header, 1)), files::bytes_of(index), padding,
               files::bytes_of(data), tail});
    return header;
}

}  // namespace relume::transport
