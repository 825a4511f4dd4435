// A transport directory opened for reading: everything an engine needs, checked and immutable.
#pragma once

#include "protocol/transport/file_bytes.h"
#include "protocol/transport/manifest.h"
#include "protocol/transport/seen_points.h"
#include "protocol/transport/shard_reader.h"
#include "protocol/transport/sketch.h"
#include "protocol/transport/surface.h"
#include "protocol/transport/visibility_field.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace relume::transport {

// Safe to share between threads.
class Transport {
  public:
    // Reads and checks all of it, in parallel. Throws TransportError naming file and section.
    [[nodiscard]] static std::shared_ptr<const Transport> open(
        const std::filesystem::path& directory);

    [[nodiscard]] const Manifest& manifest() const { return manifest_; }
    [[nodiscard]] const std::filesystem::path& directory() const { return directory_; }
    [[nodiscard]] const std::vector<ShardReader>& shards() const { return shards_; }
    [[nodiscard]] std::size_t column_count() const { return manifest_.column_count(); }
    [[nodiscard]] std::uint32_t channel_count() const { return manifest_.colour.channels; }

    // Quantisation step of column j, channel k.
    [[nodiscard]] float step(std::size_t column, std::uint32_t channel) const {
        return steps_[column * channel_count() + channel];
    }
    // Σ_p T(p,c,j)².
    [[nodiscard]] float energy(std::size_t column, std::uint32_t colour) const {
        return energies_[column * kColours + colour];
    }
    // Of all columns, [N][3].
    [[nodiscard]] std::span<const float> energies() const { return energies_; }
    // Bytes of column j in all shards, and of every column, [N].
    [[nodiscard]] std::uint32_t column_bytes(std::size_t column) const {
        return column_bytes_[column];
    }
    [[nodiscard]] std::span<const std::uint32_t> column_bytes() const { return column_bytes_; }
    [[nodiscard]] std::uint64_t total_bytes() const { return total_bytes_; }

    // [blocks][256], in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return coverage_; }
    // [blocks][3][256].
    [[nodiscard]] std::span<const float> tint() const { return tint_; }

    // Of kind `mesh`; none of other kinds.
    [[nodiscard]] const std::optional<Surface>& surface() const { return surface_; }

    // Of kind `image` with materials that people edit, points and what they see: blocks are
    // those of the transport, and a block has as many points in both. Of kind `mesh` perhaps a
    // visibility alone: blocks are clusters, and points their vertices. Else none.
    [[nodiscard]] const std::optional<VisibilityField>& visibility() const {
        return visibility_;
    }
    [[nodiscard]] const std::optional<SeenPoints>& seen_points() const { return seen_points_; }

    // Two sketches of independent rows: by one a server chooses what to do, by the other it
    // states its error. An estimate that has been minimised over is biased.
    [[nodiscard]] const Sketch& stating_sketch() const { return stating_sketch_; }
    [[nodiscard]] const Sketch& choosing_sketch() const { return choosing_sketch_; }

  private:
    explicit Transport(const std::filesystem::path& directory);
    void open_tables();
    void open_surface();
    void open_visibility(const VisibilityRecord& record);
    void open_materials();
    void check_point_counts() const;
    void open_shards();
    void check_columns() const;

    std::filesystem::path directory_;
    Manifest manifest_;
    std::vector<FileBytes> tables_;
    std::optional<Surface> surface_;
    std::optional<VisibilityField> visibility_;
    std::optional<SeenPoints> seen_points_;
    std::vector<ShardReader> shards_;
    std::span<const float> steps_;
    std::span<const float> energies_;
    std::span<const std::uint32_t> column_bytes_;
    std::span<const float> coverage_;
    std::span<const float> tint_;
    Sketch stating_sketch_;
    Sketch choosing_sketch_;
    std::uint64_t total_bytes_ = 0;
};

}  // namespace relume::transport
