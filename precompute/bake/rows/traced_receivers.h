// The receivers a bake is working on: what they stand for and the paths from there.
//
// Shards are baked in order, and a receiver shares the paths of its neighbours, so what is in
// reach of the current clusters is kept, and of those before them what later ones need. Each
// receiver is traced once: memory does not grow with how many there are.
#pragma once

#include "precompute/bake/base/parameters.h"
#include "precompute/bake/receivers/receivers.h"
#include "precompute/bake/rows/path_tracer.h"

#include <cstdint>
#include <map>
#include <vector>

namespace relume::bake {

class TracedReceivers {
  public:
    // Keeps references to both.
    TracedReceivers(const Receivers& receivers,
                    const PathTracer& tracer,
                    const BakeParameters& parameters);

    // Throws UsageError when the paths that are kept while `receivers` are baked shard by shard
    // could pass kMaxPathBytes.
    static constexpr std::uint64_t kMaxPathBytes = std::uint64_t{2} << 30U;
    static void check_memory(const Receivers& receivers, const BakeParameters& parameters);

    // Traces, in parallel, what is missing of these clusters' receivers and of their
    // neighbours; forgets what no cluster from `first_cluster` on needs, which never decreases.
    // Returns the rays cast.
    std::uint64_t move_to(std::uint32_t first_cluster, std::uint32_t cluster_count);

    // A receiver in reach. Thread-safe while move_to does not run.
    [[nodiscard]] const TracedReceiver& at(std::size_t receiver) const {
        const auto after = runs_.upper_bound(receiver);
        const auto& [first, traced] = *std::prev(after);
        return traced[receiver - first];
    }

    [[nodiscard]] const Receivers& receivers() const { return receivers_; }
    // Steps within which receivers share paths.
    [[nodiscard]] std::uint32_t radius() const { return radius_; }

  private:
    // Adds a run, or its parts that are not there, of receivers that are yet to be traced.
    void add_missing(const ReceiverRun& run, std::vector<ReceiverRun>& missing);
    [[nodiscard]] std::uint64_t trace(const ReceiverRun& run);

    const Receivers& receivers_;
    const PathTracer& tracer_;
    std::uint32_t radius_;
    // By the first receiver of a run.
    std::map<std::size_t, std::vector<TracedReceiver>> runs_;
};

}  // namespace relume::bake
