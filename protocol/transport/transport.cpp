#include "protocol/transport/transport.h"

#include "protocol/transport/checksum.h"
#include "protocol/transport/error.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace relume::transport {
namespace {

// Longest manifest read: 16384² pixels have 16384 shards of about 150 bytes of text each.
constexpr std::size_t kMaxManifestBytes = std::size_t{64} << 20;

Manifest read_manifest(const std::filesystem::path& path) {
    const MappedFile file(path);
    const auto bytes = file.bytes();
    if (bytes.size() > kMaxManifestBytes) {
        throw TransportError(fmt::format("{}: {} bytes, expected at most {}", path.string(),
                                         bytes.size(), kMaxManifestBytes));
    }
    return manifest_from_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                              path.string());
}

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
    // As take, and all values are finite and at least `low`.
    std::span<const float> take_floats(std::size_t count, float low, const char* what) {
        const auto values = take<float>(count);
        for (const float value : values) {
            if (!std::isfinite(value) || value < low) {
                throw TransportError(fmt::format("{}: {}: found {}, expected a number from {}",
                                                 name_, what, value, low));
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

MappedFile open_table(const std::filesystem::path& directory, const FileRecord& record) {
    const std::filesystem::path path = directory / record.file;
    MappedFile file(path);
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
    open_shards();
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
    steps_ = column_table.take_floats(columns * channel_count(), 0, "step");
    energies_ = column_table.take_floats(columns * kColours, 0, "energy");
    column_bytes_ = column_table.take<std::uint32_t>(columns);
    column_table.expect_end();

    TableReader receiver_table = reader(1, manifest_.receivers);
    coverage_ = receiver_table.take_floats(receivers, 0, "coverage");
    tint_ = receiver_table.take_floats(receivers * kColours, 0, "tint");
    receiver_table.expect_end();

    TableReader sketch_table = reader(2, manifest_.sketch);
    const auto take_sketch = [&](std::uint32_t rows, const char* scale) {
        const auto scales = sketch_table.take_floats(columns * kColours, 0, scale);
        return Sketch(rows, scales, sketch_table.take<std::int8_t>(columns * kColours * rows));
    };
    stating_sketch_ = take_sketch(manifest_.stating_rows, "scale of stating rows");
    choosing_sketch_ = take_sketch(manifest_.choosing_rows, "scale of choosing rows");
    sketch_table.expect_end();

    for (const std::uint32_t bytes : column_bytes_) {
        total_bytes_ += bytes;
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

}  // namespace relume::transport
