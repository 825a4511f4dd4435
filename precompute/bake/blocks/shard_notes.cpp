#include "precompute/bake/blocks/shard_notes.h"

#include "precompute/bake/base/error.h"
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/transport/checksum.h"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <type_traits>

namespace relume::bake {
namespace {

static_assert(std::is_trivially_copyable_v<BlockErrors>);
static_assert(std::is_trivially_copyable_v<ClusterSample>);

struct NotesHeader {
    std::uint64_t fingerprint = 0;
    std::uint64_t block_count = 0;
    std::uint64_t checksum = 0;  // of what follows
};

std::vector<std::byte> payload_of(const ShardNotes& notes) {
    std::vector<std::byte> payload;
    for (const files::Bytes part : {files::bytes_of(notes.tint), files::bytes_of(notes.errors),
                                    files::bytes_of(notes.samples)}) {
        payload.insert(payload.end(), part.begin(), part.end());
    }
    return payload;
}

}  // namespace

ShardNotesFolder::ShardNotesFolder(const std::filesystem::path& transport_directory,
                                   std::uint64_t fingerprint)
    : folder_(transport_directory / "partial"), fingerprint_(fingerprint) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) {
        throw BakeError(
            fmt::format("{}: cannot create: {}", folder_.string(), error.message()));
    }
}

std::filesystem::path ShardNotesFolder::path(std::uint32_t shard) const {
    return folder_ / fmt::format("{:05}.notes", shard);
}

void ShardNotesFolder::write(std::uint32_t shard, const ShardNotes& notes) const {
    const std::vector<std::byte> payload = payload_of(notes);
    const NotesHeader header{.fingerprint = fingerprint_,
                             .block_count = notes.errors.size(),
                             .checksum = transport::checksum(payload)};
    files::write_file_atomically(path(shard), {std::as_bytes(std::span(&header, 1)), payload});
}

std::optional<ShardNotes> ShardNotesFolder::read(std::uint32_t shard,
                                                 const ShardClusters& of) const {
    ShardNotes notes;
    notes.tint.resize(std::size_t{of.block_count} * transport::kColours *
                      transport::kBlockSize);
    notes.errors.resize(of.block_count);
    notes.samples.resize(of.cluster_count);
    const std::size_t expected = sizeof(NotesHeader) + notes.tint.size() * sizeof(float) +
                                 notes.errors.size() * sizeof(BlockErrors) +
                                 notes.samples.size() * sizeof(ClusterSample);
    NotesHeader header;
    std::string bytes;
    try {
        bytes = files::read_regular_file(path(shard), expected);
    } catch (const files::FileError&) {
        return std::nullopt;
    }
    if (bytes.size() != expected) {
        return std::nullopt;
    }
    const char* at = bytes.data();
    const auto take = [&at](void* target, std::size_t size) {
        std::memcpy(target, at, size);
        at += size;
    };
    take(&header, sizeof(header));
    take(notes.tint.data(), notes.tint.size() * sizeof(float));
    take(notes.errors.data(), notes.errors.size() * sizeof(BlockErrors));
    take(notes.samples.data(), notes.samples.size() * sizeof(ClusterSample));
    if (header.fingerprint != fingerprint_ || header.block_count != of.block_count ||
        header.checksum != transport::checksum(payload_of(notes))) {
        return std::nullopt;
    }
    return notes;
}

void ShardNotesFolder::remove() const {
    std::error_code ignored;  // a left-over folder does no harm
    std::filesystem::remove_all(folder_, ignored);
}

}  // namespace relume::bake
