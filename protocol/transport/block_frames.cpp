#include "protocol/transport/block_frames.h"

#include "protocol/base/files/atomic_file.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace relume::transport {
namespace {

constexpr std::uint32_t kVersion = 1;
// Rays that were cast by chance compress little better at any price.
constexpr int kZstdLevel = 3;

struct Header {
    std::array<char, 8> magic{};
    std::uint32_t version = 0;
    std::uint32_t blocks = 0;
    std::uint64_t records = 0;
    std::uint32_t parameter = 0;
    std::uint32_t record_bytes = 0;
};
static_assert(sizeof(Header) == 32);

struct IndexEntry {
    std::uint64_t offset = 0;  // from the beginning of the file
    std::uint32_t bytes = 0;
    std::uint32_t records = 0;
};
static_assert(sizeof(IndexEntry) == 16);

std::string zstd_text(const char* what, std::size_t status) {
    return fmt::format("{}: {}", what, ZSTD_getErrorName(status));
}

}  // namespace

BlockFrames::BlockFrames(std::span<const std::byte> bytes,
                         std::string file,
                         const std::array<char, 8>& magic)
    : bytes_(bytes), file_(std::move(file)) {
    read_header(magic);
    read_index();
}

void BlockFrames::fail(const std::string& where,
                       const std::string& found,
                       const std::string& expected) const {
    throw TransportError(
        fmt::format("{}: {}: found {}, expected {}", file_, where, found, expected));
}

void BlockFrames::read_header(const std::array<char, 8>& magic) {
    Header header;
    if (bytes_.size() < sizeof(header)) {
        fail("length", fmt::format("{} bytes", bytes_.size()),
             fmt::format("at least {}", sizeof(header)));
    }
    std::memcpy(&header, bytes_.data(), sizeof(header));
    if (header.magic != magic) {
        fail("magic", "something else", std::string(magic.begin(), magic.end()));
    }
    if (header.version != kVersion) {
        fail("version", fmt::format("{}", header.version), fmt::format("{}", kVersion));
    }
    const std::uint64_t index_end = sizeof(header) + std::uint64_t{header.blocks} * 16;
    if (index_end > bytes_.size()) {
        fail("length", fmt::format("{} bytes", bytes_.size()),
             fmt::format("at least {} for the index of {} blocks", index_end, header.blocks));
    }
    form_ = {
        .magic = magic, .parameter = header.parameter, .record_bytes = header.record_bytes};
    stated_records_ = header.records;
    first_record_.assign(std::size_t{header.blocks} + 1, 0);
    first_byte_.assign(std::size_t{header.blocks} + 1, index_end);
}

void BlockFrames::read_index() {
    for (std::uint32_t block = 0; block < block_count(); ++block) {
        IndexEntry entry;
        std::memcpy(&entry, bytes_.data() + sizeof(Header) + block * sizeof(entry),
                    sizeof(entry));
        const auto where = [&](const char* what) {
            return fmt::format("block {}: {}", block, what);
        };
        const std::uint64_t begin = first_byte_[block];
        if (entry.offset != begin) {
            fail(where("offset"), fmt::format("{}", entry.offset), fmt::format("{}", begin));
        }
        if (entry.bytes > bytes_.size() - begin) {
            fail(where("length"), fmt::format("{} bytes", entry.bytes),
                 fmt::format("at most {}", bytes_.size() - begin));
        }
        if (entry.records > kMostRecordsOfBlock ||
            std::uint64_t{entry.records} * form_.record_bytes > kMostBytesOfBlock) {
            fail(where("count of points"), fmt::format("{}", entry.records),
                 fmt::format("at most {} of together {} bytes", kMostRecordsOfBlock,
                             kMostBytesOfBlock));
        }
        first_byte_[block + 1] = begin + entry.bytes;
        first_record_[block + 1] = first_record_[block] + entry.records;
        if (entry.records == 0) {
            if (entry.bytes != 0) {
                fail(where("length"), fmt::format("{} bytes", entry.bytes),
                     "none for no points");
            }
            continue;
        }
        // Zstd's own values for a frame that is none are larger than any size.
        const std::uint64_t stated =
            ZSTD_getFrameContentSize(bytes_.data() + begin, entry.bytes);
        if (stated != bytes_of_block(block)) {
            fail(where("frame"), "another size or none",
                 fmt::format("a zstd frame of {} bytes", bytes_of_block(block)));
        }
    }
    if (first_record_.back() != stated_records_) {
        fail("count of points", fmt::format("{} in the blocks", first_record_.back()),
             fmt::format("{} as the header says", stated_records_));
    }
    if (first_byte_.back() != bytes_.size()) {
        fail("length", fmt::format("{} bytes", bytes_.size()),
             fmt::format("{} by the index", first_byte_.back()));
    }
}

std::span<const std::byte> BlockFrames::frame(std::uint32_t block) const {
    return bytes_.subspan(first_byte_[block], first_byte_[block + 1] - first_byte_[block]);
}

void BlockFrames::read(std::uint32_t block, std::span<std::byte> into) const {
    const std::span<const std::byte> packed = frame(block);
    if (packed.empty()) {
        return;
    }
    const std::string where = fmt::format("block {}: frame", block);
    const std::size_t whole = ZSTD_findFrameCompressedSize(packed.data(), packed.size());
    if (ZSTD_isError(whole) != 0 || whole != packed.size()) {
        fail(where,
             ZSTD_isError(whole) != 0 ? zstd_text("a broken one", whole)
                                      : fmt::format("one of {} bytes", whole),
             fmt::format("exactly one of {}", packed.size()));
    }
    const std::size_t length =
        ZSTD_decompress(into.data(), into.size(), packed.data(), packed.size());
    if (ZSTD_isError(length) != 0 || length != into.size()) {
        fail(where,
             ZSTD_isError(length) != 0 ? zstd_text("a broken one", length)
                                       : fmt::format("{} bytes in it", length),
             fmt::format("{} bytes", into.size()));
    }
}

BlockFramesBuilder::BlockFramesBuilder(const BlockFramesForm& form, std::uint32_t block_count)
    : form_(form), counts_(block_count), frames_(block_count) {}

void BlockFramesBuilder::set_block(std::uint32_t block, std::span<const std::byte> records) {
    const std::size_t count = records.size() / form_.record_bytes;
    if (records.size() % form_.record_bytes != 0 || count > kMostRecordsOfBlock ||
        records.size() > kMostBytesOfBlock) {
        throw TransportError(fmt::format(
            "{}: block {}: found {} bytes, expected at most {} points of {} bytes, "
            "and at most {} bytes",
            std::string_view(form_.magic.data(), form_.magic.size()), block, records.size(),
            kMostRecordsOfBlock, form_.record_bytes, kMostBytesOfBlock));
    }
    counts_.at(block) = static_cast<std::uint32_t>(count);
    std::vector<std::byte>& frame = frames_[block];
    if (count == 0) {
        frame.clear();
        return;
    }
    frame.resize(ZSTD_compressBound(records.size()));
    const std::size_t length =
        ZSTD_compress(frame.data(), frame.size(), records.data(), records.size(), kZstdLevel);
    if (ZSTD_isError(length) != 0) {
        throw TransportError(fmt::format("block {}: {}", block, zstd_text("zstd", length)));
    }
    frame.resize(length);
    frame.shrink_to_fit();
}

std::uint64_t BlockFramesBuilder::record_count() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : counts_) {
        sum += count;
    }
    return sum;
}

std::uint64_t BlockFramesBuilder::file_bytes() const {
    std::uint64_t sum = sizeof(Header) + frames_.size() * sizeof(IndexEntry);
    for (const std::vector<std::byte>& frame : frames_) {
        sum += frame.size();
    }
    return sum;
}

std::vector<std::byte> BlockFramesBuilder::head() const {
    const Header header{.magic = form_.magic,
                        .version = kVersion,
                        .blocks = static_cast<std::uint32_t>(frames_.size()),
                        .records = record_count(),
                        .parameter = form_.parameter,
                        .record_bytes = form_.record_bytes};
    std::vector<IndexEntry> index;
    std::uint64_t offset = sizeof(header) + frames_.size() * sizeof(IndexEntry);
    for (std::size_t block = 0; block < frames_.size(); ++block) {
        index.push_back({.offset = offset,
                         .bytes = static_cast<std::uint32_t>(frames_[block].size()),
                         .records = counts_[block]});
        offset += frames_[block].size();
    }
    const auto of_index = std::as_bytes(std::span(index));
    std::vector<std::byte> bytes(sizeof(header) + of_index.size());
    std::memcpy(bytes.data(), &header, sizeof(header));
    std::copy(of_index.begin(), of_index.end(), bytes.begin() + sizeof(header));
    return bytes;
}

std::vector<std::byte> BlockFramesBuilder::bytes() const {
    std::vector<std::byte> bytes = head();
    for (const std::vector<std::byte>& frame : frames_) {
        bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    return bytes;
}

FileRecord BlockFramesBuilder::write(const std::filesystem::path& directory,
                                     const std::string& name) const {
    const std::vector<std::byte> first = head();
    std::vector<files::Bytes> parts{first};
    parts.insert(parts.end(), frames_.begin(), frames_.end());
    files::write_file_atomically(directory / name, parts);
    return {.file = name, .bytes = file_bytes(), .checksum = checksum(parts)};
}

}  // namespace relume::transport
