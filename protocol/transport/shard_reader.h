// One shard, read and checked once, and handed out as segments that need no further check.
#pragma once

#include "protocol/transport/cell.h"
#include "protocol/transport/file_bytes.h"
#include "protocol/transport/shard_header.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

namespace relume::transport {

// What the cells of a shard amount to, per encoding.
struct CellStatistics {
    std::array<std::uint64_t, kCellTagCount> cells{};
    std::array<std::uint64_t, kCellTagCount> nonzeros{};
    std::array<std::uint64_t, kCellTagCount> bytes{};

    void add(const CellStatistics& other);
};

// Immutable; safe to read from any thread.
class ShardReader {
  public:
    // Reads the file and checks header, index and data down to every cell. Throws
    // TransportError naming file and section.
    explicit ShardReader(const std::filesystem::path& path);

    [[nodiscard]] const ShardHeader& header() const { return header_; }
    [[nodiscard]] std::uint32_t first_block() const { return header_.first_block; }
    [[nodiscard]] std::uint32_t block_count() const { return header_.block_count; }

    // Segment of column j (coefficient) and channel k.
    [[nodiscard]] SegmentView segment(std::size_t column, std::uint32_t channel) const {
        const std::size_t i = column * header_.channels + channel;
        const std::uint32_t begin = index_[i];
        if (begin == index_[i + 1]) {
            return {};
        }
        const std::uint8_t* tags = data_.data() + begin;
        return {.tags = tags,
                .cells = tags + tag_bytes(header_.block_count),
                .end = data_.data() + index_[i + 1]};
    }
    [[nodiscard]] std::uint32_t segment_bytes(std::size_t column, std::uint32_t channel) const {
        const std::size_t i = column * header_.channels + channel;
        return index_[i + 1] - index_[i];
    }
    [[nodiscard]] CellStatistics statistics() const;

  private:
    void check_index(std::string_view file) const;
    void check_segments(std::string_view file) const;

    FileBytes file_;
    ShardHeader header_;
    std::span<const std::uint32_t> index_;
    std::span<const std::uint8_t> data_;
};

}  // namespace relume::transport
