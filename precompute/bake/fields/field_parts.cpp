#include "precompute/bake/fields/field_parts.h"

#include "precompute/bake/base/error.h"
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/transport/checksum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <span>

namespace relume::bake {
namespace {

constexpr std::size_t kMostPartBytes = std::size_t{1} << 34U;

struct PartHeader {
    std::uint64_t fingerprint = 0;
    std::uint64_t first_block = 0;
    std::uint64_t block_count = 0;
    FieldCounts counts;
    std::uint64_t visibility_bytes = 0;
    std::uint64_t points_bytes = 0;
    std::uint64_t checksum = 0;  // of both
};

std::uint64_t checksum_of(const FinishedPart& part) {
    const std::vector<files::Bytes> parts{part.visibility, part.points};
    return transport::checksum(parts);
}

}  // namespace

FieldPartsFolder::FieldPartsFolder(const std::filesystem::path& transport_directory,
                                   std::uint64_t fingerprint)
    : folder_(transport_directory / "partial"), fingerprint_(fingerprint) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) {
        throw BakeError(
            fmt::format("{}: cannot create: {}", folder_.string(), error.message()));
    }
}

std::filesystem::path FieldPartsFolder::path(const FieldPart& part) const {
    return folder_ / fmt::format("{:08}.fields", part.first_block);
}

void FieldPartsFolder::write(const FieldPart& part, const FinishedPart& finished) const {
    const PartHeader header{.fingerprint = fingerprint_,
                            .first_block = part.first_block,
                            .block_count = part.block_count,
                            .counts = finished.counts,
                            .visibility_bytes = finished.visibility.size(),
                            .points_bytes = finished.points.size(),
                            .checksum = checksum_of(finished)};
    files::write_file_atomically(path(part), {std::as_bytes(std::span(&header, 1)),
                                              finished.visibility, finished.points});
}

std::optional<FinishedPart> FieldPartsFolder::read(const FieldPart& part) const {
    std::string bytes;
    try {
        bytes = files::read_regular_file(path(part), kMostPartBytes);
    } catch (const files::FileError&) {
        return std::nullopt;
    }
    PartHeader header;
    if (bytes.size() < sizeof(header)) {
        return std::nullopt;
    }
    std::memcpy(&header, bytes.data(), sizeof(header));
    const std::size_t body = bytes.size() - sizeof(header);
    if (header.fingerprint != fingerprint_ || header.first_block != part.first_block ||
        header.block_count != part.block_count || header.visibility_bytes > body ||
        header.points_bytes != body - header.visibility_bytes) {
        return std::nullopt;
    }
    const auto all = std::as_bytes(std::span(bytes)).subspan(sizeof(header));
    const auto visibility = all.first(header.visibility_bytes);
    const auto points = all.subspan(header.visibility_bytes);
    FinishedPart finished{.counts = header.counts,
                          .visibility = {visibility.begin(), visibility.end()},
                          .points = {points.begin(), points.end()}};
    if (header.checksum != checksum_of(finished)) {
        return std::nullopt;
    }
    return finished;
}

}  // namespace relume::bake
