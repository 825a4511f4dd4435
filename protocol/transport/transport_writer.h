// Writes a transport directory: shards as they come, then tables and manifest. A killed bake
// resumes at the first missing shard.
#pragma once

#include "protocol/transport/manifest.h"
#include "protocol/transport/seen_points.h"
#include "protocol/transport/shard_reader.h"
#include "protocol/transport/shard_writer.h"
#include "protocol/transport/surface.h"
#include "protocol/transport/visibility_field.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace relume::transport {

// Which blocks make shard number i: a run of them, that follows the run of shard i − 1.
class ShardPlan {
  public:
    // Shards of equal length but for the last.
    [[nodiscard]] static ShardPlan equal(std::uint32_t block_count,
                                         std::uint32_t blocks_per_shard);

    // Appends a shard of 1 … kMaxBlocksPerShard blocks.
    void add(std::uint32_t block_count) { ends_.push_back(ends_.back() + block_count); }

    [[nodiscard]] std::uint32_t shard_count() const {
        return static_cast<std::uint32_t>(ends_.size() - 1);
    }
    [[nodiscard]] std::uint32_t first_block(std::uint32_t shard) const { return ends_[shard]; }
    [[nodiscard]] std::uint32_t blocks_in(std::uint32_t shard) const {
        return ends_[shard + 1] - ends_[shard];
    }

  private:
    std::vector<std::uint32_t> ends_{0};
};

// Per-receiver and per-column tables the bake knows; the rest is computed from the shards.
struct BakedTables {
    std::vector<float> steps;     // [N][K]
    std::vector<float> coverage;  // [blocks][256]
    std::vector<float> tint;      // [blocks][3][256]
};

class TransportWriter {
  public:
    // `manifest` gives everything but files, shards and `measured`. Creates the directory.
    // Removes a manifest left by another bake, so that a half-written directory never passes
    // for a whole one.
    TransportWriter(std::filesystem::path directory, Manifest manifest, ShardPlan plan);

    // Whether the shard is there already, whole, and of this bake (same fingerprint and plan).
    [[nodiscard]] bool has_shard(std::uint32_t shard) const;
    // Thread-safe for different shards.
    void write_shard(std::uint32_t shard, const std::vector<EncodedBlock>& blocks) const;

    // Replaces what the manifest says of it: it may be known only when all shards are baked.
    void state_sampling_error(const SamplingError& error) { manifest_.sampling_error = error; }

    // Of kind `mesh`, before finish(): writes mesh.bin, brdfs.bin and textures.bin.
    void write_surface(const Surface& surface);

    // Of kind `image`, before finish(): writes visibility.bin and points.bin. The fields have
    // the transport's blocks, each with as many points in both; 1 … 16 materials.
    void write_materials(const VisibilityFieldBuilder& visibility,
                         const SeenPointsBuilder& points,
                         std::vector<EditableRecord> editable);

    // Of kind `mesh`, before finish(): writes visibility.bin, a block for each cluster.
    void write_visibility(const VisibilityFieldBuilder& visibility);

    // Reads all shards back, sums column energies, bytes and the sketches from what is
    // *stored*, writes the tables and, last of all, the manifest with `measured` and cell
    // statistics added to it. Throws TransportError when a shard is missing.
    void finish(const BakedTables& tables, const nlohmann::json& measured);

    [[nodiscard]] const ShardPlan& plan() const { return plan_; }

  private:
    [[nodiscard]] std::filesystem::path shard_path(std::uint32_t shard) const;

    std::filesystem::path directory_;
    Manifest manifest_;
    ShardPlan plan_;
};

}  // namespace relume::transport
