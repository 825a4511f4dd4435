#include "precompute/bake/output_directory.h"

#include "precompute/bake/bake.h"
#include "protocol/base/files/disk_room.h"
#include "protocol/base/files/error.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/names.h"
#include "protocol/transport/receiver_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuffix = ".relume";
constexpr std::array kFolders{"shards", "view", "partial"};

void make_directory(const fs::path& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error && !fs::is_directory(path, error) && !error) {
        error = std::make_error_code(std::errc::not_a_directory);
    }
    if (error) {
        throw files::FileError(
            fmt::format("{}: cannot create the folder: {}", path.string(), error.message()));
    }
}

void remove_what_is_empty(const fs::path& directory) {
    std::error_code ignored;
    for (const fs::path& folder :
         {directory / "shards", directory / "view", directory / "partial", directory}) {
        if (fs::is_empty(folder, ignored) && !ignored) {
            fs::remove(folder, ignored);
        }
    }
}

// Whatever a bake writes under a name of its own: no folder may have it.
void require_free_names(const fs::path& directory) {
    for (const char* name :
         {"manifest.json", "columns.bin", "receivers.bin", "sketch.bin", "report.json",
          "view/albedo.exr", "view/depth.exr", "view/thumbnail.png", "view/picture.png",
          "view/materials.png", "visibility.bin", "points.bin"}) {
        files::require_replaceable(directory / name);
    }
    for (const char* folder : {"shards", "partial"}) {
        for (const fs::directory_entry& entry : fs::directory_iterator(directory / folder)) {
            const fs::path extension = entry.path().extension();
            if (extension == ".shard" || extension == ".notes" || extension == ".fields") {
                files::require_replaceable(entry.path());
            }
        }
    }
}

}  // namespace

fs::path transport_directory_from_option(const std::string& text) {
    const auto refuse = [&](const std::string& why) {
        throw program::UsageError(
            fmt::format("-o {}: found {}, expected NAME{}", text, why, kSuffix));
    };
    fs::path path(text);
    if (!path.has_filename()) {
        path = path.parent_path();  // of "mine.relume/"
    }
    if (path.filename().empty() || path.filename() == "." || path.filename() == "..") {
        refuse("no name");
    }
    if (path.extension().empty()) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored)) {
            refuse(
                fmt::format("a folder that is there already; to bake into it, give a name in "
                            "it, as {}/mine{}",
                            path.string(), kSuffix));
        }
        path += kSuffix;
    }
    if (path.extension() != kSuffix) {
        refuse(fmt::format("a name that ends in {}", path.extension().string()));
    }
    if (!text::is_name(path.stem().string())) {
        refuse(fmt::format("the name \"{}\", which no server serves; a name is {}",
                           path.stem().string(), text::kNameRule));
    }
    return path;
}

LeastBytes least_bytes(const BakeParameters& parameters, const FieldRequest& fields) {
    const transport::TileGrid image{.width = parameters.width, .height = parameters.height};
    const std::uint64_t columns = signal_basis(parameters).coefficient_count();
    const std::uint64_t blocks =
        parameters.receivers == ReceiverKind::pixels ? image.block_count() : 1;
    constexpr std::uint64_t kColours = transport::kColours;
    const std::uint64_t column_table = columns * 4 * (1 + kColours + 1);
    const std::uint64_t receivers = blocks * transport::kBlockSize * 4 * (1 + kColours);
    const std::uint64_t sketch = columns * kColours * (2 * 4 + kStatingRows + kChoosingRows);
    const std::uint64_t shard = 4 * (columns + 1);
    const std::uint64_t shards =
        (blocks + transport::kMaxBlocksPerShard - 1) / transport::kMaxBlocksPerShard;
    // Of visibility.bin and points.bin: a head, and an entry for each block.
    const std::uint64_t field = fields.empty() ? 0 : 32 + 16 * blocks;
    return {.total = column_table + receivers + sketch + shards * shard + 2 * field,
            .longest_file = std::max({column_table, receivers, sketch, shard, field})};
}

OutputDirectory::OutputDirectory(fs::path path,
                                 const BakeParameters& parameters,
                                 const FieldRequest& fields)
    : path_(std::move(path)) {
    make_directory(path_);
    lock_.emplace(path_);
    try {
        for (const char* folder : kFolders) {
            make_directory(path_ / folder);
        }
        require_free_names(path_);
        const LeastBytes least = least_bytes(parameters, fields);
        files::require_room(path_, least.total, least.longest_file);
        for (const char* folder : kFolders) {
            files::require_room(path_ / folder, 0, 0);
        }
    } catch (...) {
        remove_what_is_empty(path_);
        throw;
    }
}

OutputDirectory::~OutputDirectory() {
    remove_what_is_empty(path_);
}

}  // namespace relume::bake
