// A transport directory opened for reading: everything an engine needs, checked and immutable.
#pragma once

#include "protocol/transport/manifest.h"
#include "protocol/transport/mapped_file.h"
#include "protocol/transport/shard_reader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace relume::transport {

// Safe to share between threads.
class Transport {
  public:
    // Maps and checks all of it, in parallel. Throws TransportError naming file and section.
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
    // Bytes of column j in all shards.
    [[nodiscard]] std::uint32_t column_bytes(std::size_t column) const {
        return column_bytes_[column];
    }
    [[nodiscard]] std::uint64_t total_bytes() const { return total_bytes_; }

    // [blocks][256], in [0, 1].
    [[nodiscard]] std::span<const float> coverage() const { return coverage_; }
    // [blocks][3][256].
    [[nodiscard]] std::span<const float> tint() const { return tint_; }

    // Sketch of column j, colour c: `rows` integers, times the scale.
    [[nodiscard]] std::span<const std::int16_t> sketch(std::size_t column,
                                                       std::uint32_t colour) const {
        const std::size_t rows = manifest_.sketch_rows;
        return sketch_values_.subspan((column * kColours + colour) * rows, rows);
    }
    [[nodiscard]] float sketch_scale(std::size_t column, std::uint32_t colour) const {
        return sketch_scales_[column * kColours + colour];
    }

  private:
    explicit Transport(const std::filesystem::path& directory);
    void open_tables();
    void open_shards();

    std::filesystem::path directory_;
    Manifest manifest_;
    std::vector<MappedFile> tables_;
    std::vector<ShardReader> shards_;
    std::span<const float> steps_;
    std::span<const float> energies_;
    std::span<const std::uint32_t> column_bytes_;
    std::span<const float> coverage_;
    std::span<const float> tint_;
    std::span<const float> sketch_scales_;
    std::span<const std::int16_t> sketch_values_;
    std::uint64_t total_bytes_ = 0;
};

}  // namespace relume::transport
