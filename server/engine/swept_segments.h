// The columns that a sweep adds in one shard and band: of every session that is swept, a list.
#pragma once

#include "server/engine/column_change.h"
#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/accumulate_batch.h"
#include "server/engine/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// One thread's, kept from band to band.
class SweptSegments {
  public:
    static SweptSegments& of_this_thread();

    void begin() { count_ = 0; }
    // A new member's list, empty; at most kMaxBatchMembers.
    std::vector<WeightedSegment>& add(const SumTargets& targets);
    // Adds every member's segments to its targets, by the kernel that is the faster one.
    void accumulate(std::uint32_t block_count) const;

  private:
    [[nodiscard]] double shared() const;

    std::array<std::vector<WeightedSegment>, kMaxBatchMembers> lists_;
    std::array<SumTargets, kMaxBatchMembers> targets_;
    std::size_t count_ = 0;
};

// Appends the segments of the changed columns in one shard; the blocks in which they have
// cells.
std::uint64_t gather_changes(const transport::Transport& transport,
                             std::size_t shard,
                             std::span<const ColumnChange> changes,
                             std::vector<WeightedSegment>& segments);

// Appends the segments of all columns of a band in one shard that the lighting, planar [3][N],
// has light for. Groups end at the same columns whatever the light, so that lights can be swept
// together.
void gather_lighting(const Scene& scene,
                     std::size_t shard,
                     std::uint32_t band,
                     std::span<const float> lighting,
                     std::vector<WeightedSegment>& segments);

}  // namespace relume::engine
