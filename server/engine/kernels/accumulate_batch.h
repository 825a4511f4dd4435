// The inner loop for several sessions of one scene at once: what two of them want of a column
// is read and decoded once for both.
#pragma once

#include "server/engine/kernels/accumulate.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace relume::engine {

inline constexpr std::size_t kMaxBatchMembers = 16;

// One session's part in a batch.
struct BatchMember {
    // In the order of memory, as the columns of a band are.
    std::span<const WeightedSegment> segments;
    SumTargets targets;
};

// Gives every member what accumulate_segments gives it, to the last bit: its groups are its
// own. The members, at most kMaxBatchMembers, are of the same shard; no two share a target.
//
// All members' first groups are gone through together, then their second ones: the fewer
// columns the members have in common, the less is saved, and nothing of the result depends on
// it.
using AccumulateBatch = void(std::span<const BatchMember> members, std::uint32_t block_count);

// The specification: one member after the other.
AccumulateBatch accumulate_batch_scalar;
// The best the processor has, or what RELUME_FORCE_TARGET names (kernels/target.h).
AccumulateBatch accumulate_batch;

}  // namespace relume::engine
