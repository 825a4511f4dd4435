#include "protocol/transport/transport_writer.h"

#include "protocol/base/files/atomic_file.h"
#include "protocol/brdf/brdf_file.h"
#include "protocol/transport/checksum.h"
#include "protocol/transport/column_summary.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace relume::transport {
namespace {

FileRecord write_table(const std::filesystem::path& directory,
                       const std::string& name,
                       std::initializer_list<files::Bytes> parts) {
    std::vector<std::byte> bytes;
    for (const files::Bytes part : parts) {
        bytes.insert(bytes.end(), part.begin(), part.end());
    }
    files::write_file_atomically(directory / name, {bytes});
    return {.file = name, .bytes = bytes.size(), .checksum = checksum(bytes)};
}

std::string shard_file(std::uint32_t shard) {
    return fmt::format("shards/{:05}.shard", shard);
}

nlohmann::json json_from(const CellStatistics& statistics) {
    nlohmann::json object = nlohmann::json::object();
    for (std::size_t i = 0; i < kCellTagCount; ++i) {
        object[kCellTagNames[i]] = {{"cells", statistics.cells[i]},
                                    {"nonzeros", statistics.nonzeros[i]},
                                    {"bytes", statistics.bytes[i]}};
    }
    return object;
}

void require_size(const char* what, std::size_t found, std::size_t expected) {
    if (found != expected) {
        throw TransportError(fmt::format("{}: {} values, expected {}", what, found, expected));
    }
}

}  // namespace

ShardPlan ShardPlan::equal(std::uint32_t block_count, std::uint32_t blocks_per_shard) {
    ShardPlan plan;
    for (std::uint32_t block = 0; block < block_count; block += blocks_per_shard) {
        plan.add(std::min(blocks_per_shard, block_count - block));
    }
    return plan;
}

TransportWriter::TransportWriter(std::filesystem::path directory,
                                 Manifest manifest,
                                 ShardPlan plan)
    : directory_(std::move(directory)), manifest_(std::move(manifest)), plan_(std::move(plan)) {
    std::error_code error;
    std::filesystem::create_directories(directory_ / "shards", error);
    if (error) {
        throw TransportError(
            fmt::format("{}: cannot create: {}", directory_.string(), error.message()));
    }
    std::filesystem::remove(directory_ / "manifest.json", error);
}

std::filesystem::path TransportWriter::shard_path(std::uint32_t shard) const {
    return directory_ / shard_file(shard);
}

bool TransportWriter::has_shard(std::uint32_t shard) const {
    const std::filesystem::path path = shard_path(shard);
    if (!std::filesystem::exists(path)) {
        return false;
    }
    try {
        const ShardReader reader(path);
        const ShardHeader& header = reader.header();
        return header.number == shard && header.first_block == plan_.first_block(shard) &&
               header.block_count == plan_.blocks_in(shard) &&
               header.columns == manifest_.column_count() &&
               header.channels == manifest_.colour.channels &&
               header.fingerprint == manifest_.fingerprint;
    } catch (const TransportError&) {
        return false;  // a broken shard is baked again, like a missing one
    }
}

void TransportWriter::write_shard(std::uint32_t shard,
                                  const std::vector<EncodedBlock>& blocks) const {
    require_size("blocks of a shard", blocks.size(), plan_.blocks_in(shard));
    transport::write_shard(shard_path(shard),
                           {.number = shard,
                            .first_block = plan_.first_block(shard),
                            .columns = manifest_.column_count(),
                            .channels = manifest_.colour.channels,
                            .fingerprint = manifest_.fingerprint},
                           blocks);
}

void TransportWriter::write_surface(const Surface& surface) {
    MeshSection& mesh = manifest_.mesh.value();
    mesh.mesh = write_table(directory_, "mesh.bin", {bytes_from_surface_mesh(surface.mesh)});
    mesh.brdfs = write_table(directory_, "brdfs.bin", {brdf::bytes_from_brdfs(surface.brdfs)});
    mesh.textures =
        write_table(directory_, "textures.bin", {bytes_from_textures(surface.textures)});
}

void TransportWriter::write_materials(const VisibilityFieldBuilder& visibility,
                                      const SeenPointsBuilder& points,
                                      std::vector<EditableRecord> editable) {
    manifest_.materials =
        MaterialsSection{.visibility = {.face_resolution = visibility.face_resolution(),
                                        .file = visibility.write(directory_)},
                         .points = points.write(directory_),
                         .editable = std::move(editable)};
}

void TransportWriter::write_visibility(const VisibilityFieldBuilder& visibility) {
    manifest_.visibility = VisibilityRecord{.face_resolution = visibility.face_resolution(),
                                            .file = visibility.write(directory_)};
}

void TransportWriter::finish(const BakedTables& tables, const nlohmann::json& measured) {
    const std::size_t receivers = std::size_t{manifest_.block_count()} * kBlockSize;
    require_size("steps", tables.steps.size(),
                 std::size_t{manifest_.column_count()} * manifest_.colour.channels);
    require_size("coverage", tables.coverage.size(), receivers);
    require_size("tint", tables.tint.size(), receivers * kColours);

    std::vector<ShardReader> shards;
    CellStatistics statistics;
    manifest_.shards.clear();
    for (std::uint32_t shard = 0; shard < plan_.shard_count(); ++shard) {
        shards.emplace_back(shard_path(shard));
        const ShardHeader& header = shards.back().header();
        statistics.add(shards.back().statistics());
        manifest_.shards.push_back({.file = shard_file(shard),
                                    .bytes = header.file_bytes(),
                                    .header_checksum = header.header_checksum,
                                    .first_block = header.first_block,
                                    .block_count = header.block_count});
    }
    const ColumnSummary summary =
        summarise_columns(manifest_, shards, tables.steps, tables.tint);
    manifest_.columns =
        write_table(directory_, "columns.bin",
                    {files::bytes_of(tables.steps), files::bytes_of(summary.energies),
                     files::bytes_of(summary.column_bytes)});
    manifest_.receivers =
        write_table(directory_, "receivers.bin",
                    {files::bytes_of(tables.coverage), files::bytes_of(tables.tint)});
    manifest_.sketch = write_table(
        directory_, "sketch.bin",
        {files::bytes_of(summary.stating.scales), files::bytes_of(summary.stating.values),
         files::bytes_of(summary.choosing.scales), files::bytes_of(summary.choosing.values)});
    manifest_.measured = measured;
    manifest_.measured["cells"] = json_from(statistics);
    const std::string text = text_from_manifest(manifest_);
    files::write_file_atomically(directory_ / "manifest.json", {files::bytes_of(text)});
}

}  // namespace relume::transport
