// A file of records that belong to blocks: one zstd frame for the records of each block, with
// an index in front (protocol/README.md §2). visibility.bin and points.bin are such files.
#pragma once

#include "protocol/transport/file_record.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relume::transport {

// What tells such files apart.
struct BlockFramesForm {
    std::array<char, 8> magic{};
    std::uint32_t parameter = 0;     // of the kind of file; 0 where it has none
    std::uint32_t record_bytes = 0;  // of one record, uncompressed

    friend bool operator==(const BlockFramesForm&, const BlockFramesForm&) = default;
};

// Limits of a block, so that a reader's memory has a bound.
inline constexpr std::uint32_t kMostRecordsOfBlock = 65'535;
inline constexpr std::size_t kMostBytesOfBlock = std::size_t{1} << 28;  // uncompressed

// A file opened for reading. Immutable and thread-safe.
class BlockFrames {
  public:
    // Keeps the span, whose bytes outlive the object. Checks header and index: form, counts,
    // limits, frames without gap up to the end of the file, each of the size that its count of
    // records has. Throws TransportError naming `file`, what was found and what was expected.
    BlockFrames(std::span<const std::byte> bytes,
                std::string file,
                const std::array<char, 8>& magic);

    [[nodiscard]] const BlockFramesForm& form() const { return form_; }
    [[nodiscard]] const std::string& file() const { return file_; }
    [[nodiscard]] std::uint32_t block_count() const {
        return static_cast<std::uint32_t>(first_record_.size() - 1);
    }
    // Of all blocks before `block`, which may be block_count().
    [[nodiscard]] std::uint64_t first_record(std::uint32_t block) const {
        return first_record_[block];
    }
    [[nodiscard]] std::uint32_t record_count(std::uint32_t block) const {
        return static_cast<std::uint32_t>(first_record_[block + 1] - first_record_[block]);
    }
    // Uncompressed bytes of the block's records.
    [[nodiscard]] std::size_t bytes_of_block(std::uint32_t block) const {
        return std::size_t{record_count(block)} * form_.record_bytes;
    }
    // Writes the block's records; `into` has bytes_of_block(block) bytes. Throws TransportError
    // where the frame is broken.
    void read(std::uint32_t block, std::span<std::byte> into) const;

  private:
    [[nodiscard]] std::span<const std::byte> frame(std::uint32_t block) const;
    [[noreturn]] void fail(const std::string& where,
                           const std::string& found,
                           const std::string& expected) const;
    void read_header(const std::array<char, 8>& magic);
    void read_index();

    std::span<const std::byte> bytes_;
    std::string file_;
    BlockFramesForm form_;
    std::uint64_t stated_records_ = 0;
    std::vector<std::uint64_t> first_record_;  // [blocks + 1]
    std::vector<std::uint64_t> first_byte_;    // [blocks + 1]
};

// A file in the making: holds the compressed frames until it is written.
class BlockFramesBuilder {
  public:
    BlockFramesBuilder(const BlockFramesForm& form, std::uint32_t block_count);

    [[nodiscard]] const BlockFramesForm& form() const { return form_; }
    // `records` are form.record_bytes times at most kMostRecordsOfBlock, and at most
    // kMostBytesOfBlock; TransportError else. Blocks may come in any order, each once, and
    // different ones from several threads at a time. A block that never comes has no records.
    void set_block(std::uint32_t block, std::span<const std::byte> records);

    [[nodiscard]] std::uint64_t record_count() const;
    [[nodiscard]] std::uint64_t file_bytes() const;
    // After the last block. The same blocks give the same bytes.
    [[nodiscard]] std::vector<std::byte> bytes() const;
    // The same as a file of the directory, written whole or not at all. Throws
    // files::FileError.
    [[nodiscard]] FileRecord write(const std::filesystem::path& directory,
                                   const std::string& name) const;

  private:
    [[nodiscard]] std::vector<std::byte> head() const;

    BlockFramesForm form_;
    std::vector<std::uint32_t> counts_;           // of records, by block
    std::vector<std::vector<std::byte>> frames_;  // by block
};

}  // namespace relume::transport
