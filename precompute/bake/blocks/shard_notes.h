// What a finished shard leaves for the end of the bake beside its file: the tints of its
// receivers, the errors measured in it and receivers that were drawn. Kept in `partial/` of the
// transport directory until the manifest is written, so that a bake that is killed can go on.
#pragma once

#include "precompute/bake/blocks/cluster_sample.h"
#include "precompute/bake/blocks/error_meter.h"
#include "precompute/bake/blocks/shard_clusters.h"
#include "protocol/transport/format.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace relume::bake {

struct ShardNotes {
    std::vector<float> tint;             // [blocks][3][256]
    std::vector<BlockErrors> errors;     // [blocks]
    std::vector<ClusterSample> samples;  // [clusters]
};

class ShardNotesFolder {
  public:
    // Creates `partial/` under the transport directory.
    ShardNotesFolder(const std::filesystem::path& transport_directory,
                     std::uint64_t fingerprint);

    void write(std::uint32_t shard, const ShardNotes& notes) const;
    // Nothing when the file is missing, broken, or of another bake.
    [[nodiscard]] std::optional<ShardNotes> read(std::uint32_t shard,
                                                 const ShardClusters& of) const;
    // Removes the folder and all in it.
    void remove() const;

  private:
    [[nodiscard]] std::filesystem::path path(std::uint32_t shard) const;

    std::filesystem::path folder_;
    std::uint64_t fingerprint_;
};

}  // namespace relume::bake
