#include "protocol/transport/transport.h"

#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace relume::transport {
namespace {

// Takes typed arrays off the front of a table.
class TableReader {
  public:
    TableReader(std::span<const std::byte> bytes, std::string name)
        : bytes_(bytes), name_(std::move(name)) {}

    template <typename T>
    std::span<const T> take(std::size_t count) {
        const std::size_t size = count * sizeof(T);
        if (size > bytes_.size()) {
            throw TransportError(
                fmt::format("{}: {} bytes are left, expected {}", name_, bytes_.size(), size));
        }
        const std::span<const T> values{reinterpret_cast<const T*>(bytes_.data()), count};
        bytes_ = bytes_.subspan(size);
        return values;
    }
    // As take, and all values lie in [0, high].
    std::span<const float> take_floats(std::size_t count,
                                       const char* what,
                                       float high = std::numeric_limits<float>::max()) {
        const auto values = take<float>(count);
        for (const float value : values) {
            if (!(value >= 0 && value <= high)) {
                throw TransportError(
                    fmt::format("{}: {}: found {}, expected {}", name_, what, value,
                                high == 1 ? "a number from 0 to 1"
                                          : "a finite number that is not negative"));
            }
        }
        return values;
    }
    void expect_end() const {
        if (!bytes_.empty()) {
            throw TransportError(fmt::format("{}: {} bytes too many", name_, bytes_.size()));
        }
    }

  private:
    std::span<const std::byte> bytes_;
    std::string name_;
};

FileBytes open_table(const std::filesystem::path& directory, const FileRecord& record) {
    const std::filesystem::path path = directory / record.file;
    FileBytes file(path);
    if (file.bytes().size() != record.bytes) {
        throw TransportError(fmt::format("{}: {} bytes, expected {}", path.string(),
                                         file.bytes().size(), record.bytes));
    }
    const std::uint64_t found = checksum(file.bytes());
    if (found != record.checksum) {
        throw TransportError(fmt::format("{}: checksum is {}, expected {}", path.string(),
                                         text_from_checksum(found),
                                         text_from_checksum(record.checksum)));
    }
    return file;
}

void check_shard(const ShardReader& shard,
                 const ShardRecord& record,
                 const Manifest& manifest,
                 std::uint32_t number,
                 const std::string& path) {
    const ShardHeader& header = shard.header();
    const auto require = [&](const char* what, std::uint64_t found, std::uint64_t expected) {
        if (found != expected) {
            throw TransportError(fmt::format("{}: header: {} is {}, the manifest expects {}",
                                             path, what, found, expected));
        }
    };
    require("file length", header.file_bytes(), record.bytes);
    require("shard number", header.number, number);
    require("first block", header.first_block, record.first_block);
    require("block count", header.block_count, record.block_count);
    require("column count", header.columns, manifest.column_count());
    require("channel count", header.channels, manifest.colour.channels);
    require("fingerprint", header.fingerprint, manifest.fingerprint);
    require("checksum", header.header_checksum, record.header_checksum);
}

}  // namespace

std::shared_ptr<const Transport> Transport::open(const std::filesystem::path& directory) {
    return std::shared_ptr<const Transport>(new Transport(directory));
}

Transport::Transport(const std::filesystem::path& directory)
    : directory_(directory), manifest_(read_manifest(directory / "manifest.json")) {
    open_tables();
    open_surface();
    open_materials();
    open_shards();
    check_columns();
}

void Transport::open_tables() {
    const std::size_t columns = manifest_.column_count();
    const std::size_t receivers = std::size_t{manifest_.block_count()} * kBlockSize;
    for (const FileRecord* record :
         {&manifest_.columns, &manifest_.receivers, &manifest_.sketch}) {
        tables_.push_back(open_table(directory_, *record));
    }
    const auto reader = [this](std::size_t table, const FileRecord& record) {
        return TableReader(tables_[table].bytes(), (directory_ / record.file).string());
    };
    TableReader column_table = reader(0, manifest_.columns);
    steps_ = column_table.take_floats(columns * channel_count(), "step");
    energies_ = column_table.take_floats(columns * kColours, "energy");
    column_bytes_ = column_table.take<std::uint32_t>(columns);
    column_table.expect_end();

    TableReader receiver_table = reader(1, manifest_.receivers);
    coverage_ = receiver_table.take_floats(receivers, "coverage", 1);
    tint_ = receiver_table.take_floats(receivers * kColours, "tint");
    receiver_table.expect_end();

    TableReader sketch_table = reader(2, manifest_.sketch);
    const auto take_sketch = [&](std::uint32_t rows, const char* scale) {
        const auto scales = sketch_table.take_floats(columns * kColours, scale);
        return Sketch(manifest_.sketch_strata(rows), scales,
                      sketch_table.take<std::int8_t>(columns * kColours * rows));
    };
    stating_sketch_ = take_sketch(manifest_.stating_rows, "scale of stating rows");
    choosing_sketch_ = take_sketch(manifest_.choosing_rows, "scale of choosing rows");
    sketch_table.expect_end();

    for (const std::uint32_t bytes : column_bytes_) {
        total_bytes_ += bytes;
    }
}

void Transport::open_surface() {
    if (!manifest_.mesh) {
        return;
    }
    const FileBytes mesh = open_table(directory_, manifest_.mesh->mesh);
    const FileBytes brdfs = open_table(directory_, manifest_.mesh->brdfs);
    const FileBytes textures = open_table(directory_, manifest_.mesh->textures);
    const auto file = [this](const FileRecord& record, const FileBytes& bytes) {
        return SurfaceFiles::File{.name = (directory_ / record.file).string(),
                                  .bytes = bytes.bytes()};
    };
    surface_ =
        surface_from_files(manifest_, {.mesh = file(manifest_.mesh->mesh, mesh),
                                       .brdfs = file(manifest_.mesh->brdfs, brdfs),
                                       .textures = file(manifest_.mesh->textures, textures)});
}

void Transport::open_visibility(const VisibilityRecord& record) {
    const std::string name = (directory_ / record.file.file).string();
    tables_.push_back(open_table(directory_, record.file));
    visibility_.emplace(tables_.back().bytes(), name);
    if (visibility_->face_resolution() != record.face_resolution) {
        throw TransportError(
            fmt::format("{}: face resolution: found {}, the manifest expects {}", name,
                        visibility_->face_resolution(), record.face_resolution));
    }
}

void Transport::open_materials() {
    if (manifest_.materials) {
        const MaterialsSection& materials = *manifest_.materials;
        open_visibility(materials.visibility);
        const FileBytes points = open_table(directory_, materials.points);
        seen_points_.emplace(points.bytes(), (directory_ / materials.points.file).string(),
                             materials.editable.size());
        check_point_counts();
    } else if (manifest_.visibility) {
        open_visibility(*manifest_.visibility);
        check_point_counts();
    }
}

// Points are those of points.bin, or else the vertices of clusters.
void Transport::check_point_counts() const {
    const FileRecord& file =
        manifest_.materials ? manifest_.materials->visibility.file : manifest_.visibility->file;
    const auto require = [&](const std::string& what, std::uint64_t found,
                             std::uint64_t expected) {
        if (found != expected) {
            throw TransportError(fmt::format("{}: {}: found {}, expected {}",
                                             (directory_ / file.file).string(), what, found,
                                             expected));
        }
    };
    const std::uint32_t blocks =
        manifest_.mesh
            ? static_cast<std::uint32_t>(manifest_.layout.clusters().clusters().size())
            : manifest_.block_count();
    require("blocks", visibility_->block_count(), blocks);
    if (seen_points_) {
        require("blocks beside those of its points", visibility_->block_count(),
                seen_points_->block_count());
    }
    for (std::uint32_t block = 0; block < blocks; ++block) {
        const std::uint32_t expected =
            seen_points_ ? seen_points_->point_count(block)
                         : manifest_.layout.clusters().clusters()[block].vertices;
        require(fmt::format("points of block {}", block), visibility_->point_count(block),
                expected);
    }
}

void Transport::open_shards() {
    std::vector<std::optional<ShardReader>> opened(manifest_.shards.size());
    tbb::parallel_for(std::size_t{0}, opened.size(), [&](std::size_t i) {
        const ShardRecord& record = manifest_.shards[i];
        const std::filesystem::path path = directory_ / record.file;
        opened[i].emplace(path);
        check_shard(*opened[i], record, manifest_, static_cast<std::uint32_t>(i),
                    path.string());
    });
    shards_.reserve(opened.size());
    for (auto& shard : opened) {
        shards_.push_back(std::move(*shard));
    }
}

// A server plans its traffic by the table of bytes, and ranks columns by their steps.
void Transport::check_columns() const {
    tbb::parallel_for(std::size_t{0}, column_count(), [this](std::size_t column) {
        std::uint64_t bytes = 0;
        for (const ShardReader& shard : shards_) {
            for (std::uint32_t channel = 0; channel < channel_count(); ++channel) {
                const std::uint32_t segment = shard.segment_bytes(column, channel);
                bytes += segment;
                if (segment > 0 && step(column, channel) == 0) {
                    throw TransportError(fmt::format(
                        "{}: step of column {} channel {}: found 0, expected a positive number "
                        "for a column that holds values",
                        (directory_ / manifest_.columns.file).string(), column, channel));
                }
            }
        }
        if (bytes != column_bytes_[column]) {
            throw TransportError(
                fmt::format("{}: bytes of column {}: found {}, expected {} as in the shards",
                            (directory_ / manifest_.columns.file).string(), column,
                            column_bytes_[column], bytes));
        }
    });
}

}  // namespace relume::transport
