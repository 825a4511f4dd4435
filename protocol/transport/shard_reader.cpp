#include "protocol/transport/shard_reader.h"

#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace relume::transport {
namespace {

void check_sum(std::string_view file,
               std::string_view section,
               std::span<const std::byte> bytes,
               std::uint64_t expected) {
    const std::uint64_t found = checksum(bytes);
    if (found != expected) {
        throw TransportError(fmt::format("{}: {}: checksum is {}, expected {}", file, section,
                                         text_from_checksum(found),
                                         text_from_checksum(expected)));
    }
}

void check_zero(std::string_view file,
                std::string_view section,
                std::span<const std::byte> bytes) {
    if (std::any_of(bytes.begin(), bytes.end(),
                    [](std::byte byte) { return byte != std::byte{0}; })) {
        throw TransportError(fmt::format("{}: {}: expected zeroes", file, section));
    }
}

// Throws when the segment's tags and cells do not fill it exactly.
void check_segment(std::span<const std::uint8_t> segment, std::uint32_t block_count) {
    if (segment.empty()) {
        return;
    }
    const std::size_t tags = tag_bytes(block_count);
    if (segment.size() < tags) {
        throw TransportError(
            fmt::format("{} bytes, expected at least {} bytes of tags", segment.size(), tags));
    }
    const SegmentView view{.tags = segment.data(),
                           .cells = segment.data() + tags,
                           .end = segment.data() + segment.size()};
    if (block_count % 2 == 1 && (segment[tags - 1] >> 4) != 0) {
        throw TransportError("the unused last tag is not zero");
    }
    std::size_t at = tags;
    bool any = false;
    for (std::uint32_t block = 0; block < block_count; ++block) {
        const auto tag = static_cast<std::uint8_t>(view.tag(block));
        at += validated_cell_bytes(tag, segment.subspan(at));
        any = any || tag != 0;
    }
    if (!any) {
        throw TransportError("a segment of empty cells, expected an empty segment");
    }
    if (at != segment.size()) {
        throw TransportError(
            fmt::format("cells end at byte {}, expected {}", at, segment.size()));
    }
}

}  // namespace

void CellStatistics::add(const CellStatistics& other) {
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        cells[i] += other.cells[i];
        nonzeros[i] += other.nonzeros[i];
        bytes[i] += other.bytes[i];
    }
}

ShardReader::ShardReader(const std::filesystem::path& path)
    : file_(path), header_(parse_shard_header(file_.bytes(), path.string())) {
    const std::string name = path.string();
    const auto bytes = file_.bytes();
    const auto index = bytes.subspan(kShardHeaderBytes, header_.index_bytes);
    const auto data = bytes.subspan(header_.data_offset(), header_.data_bytes);
    check_sum(name, "index", index, header_.index_checksum);
    check_sum(name, "data", data, header_.data_checksum);
    check_zero(name, "padding",
               bytes.first(header_.data_offset()).subspan(kShardHeaderBytes + index.size()));
    check_zero(name, "tail", bytes.last(kShardTailBytes));
    index_ = {reinterpret_cast<const std::uint32_t*>(index.data()),
              index.size() / sizeof(std::uint32_t)};
    data_ = {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()};
    check_index(name);
    check_segments(name);
}

void ShardReader::check_index(std::string_view file) const {
    if (index_.front() != 0 || index_.back() != data_.size() ||
        !std::is_sorted(index_.begin(), index_.end())) {
        throw TransportError(fmt::format("{}: index: expected ascending offsets from 0 to {}",
                                         file, data_.size()));
    }
}

void ShardReader::check_segments(std::string_view file) const {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, index_.size() - 1, 1024),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                try {
                    check_segment(data_.subspan(index_[i], index_[i + 1] - index_[i]),
                                  header_.block_count);
                } catch (const TransportError& error) {
                    throw TransportError(fmt::format("{}: data: column {} channel {}: {}", file,
                                                     i / header_.channels, i % header_.channels,
                                                     error.what()));
                }
            }
        });
}

CellStatistics ShardReader::statistics() const {
    CellStatistics statistics;
    for (std::size_t column = 0; column < header_.columns; ++column) {
        for (std::uint32_t channel = 0; channel < header_.channels; ++channel) {
            const SegmentView view = segment(column, channel);
            if (view.empty()) {
                statistics.cells[0] += header_.block_count;
                continue;
            }
            const std::uint8_t* cell = view.cells;
            for (std::uint32_t block = 0; block < header_.block_count; ++block) {
                const CellTag tag = view.tag(block);
                const auto i = static_cast<std::size_t>(tag);
                const std::size_t size = cell_bytes(tag, cell);
                ++statistics.cells[i];
                statistics.nonzeros[i] += tag == CellTag::empty ? 0 : cell_nonzeros(tag, cell);
                statistics.bytes[i] += size;
                cell += size;
            }
        }
    }
    return statistics;
}

}  // namespace relume::transport
