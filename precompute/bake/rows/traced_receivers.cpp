#include "precompute/bake/rows/traced_receivers.h"

#include "protocol/base/program/usage.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

namespace relume::bake {
namespace {

std::uint32_t pool_reach(const BakeParameters& parameters) {
    return parameters.bounces > 0 ? parameters.pool_radius : 0;
}

}  // namespace

TracedReceivers::TracedReceivers(const Receivers& receivers,
                                 const PathTracer& tracer,
                                 const BakeParameters& parameters)
    : receivers_(receivers), tracer_(tracer), radius_(pool_reach(parameters)) {}

void TracedReceivers::check_memory(const Receivers& receivers,
                                   const BakeParameters& parameters) {
    const ReachBound most = receivers.most_in_reach(parameters.pool_radius);
    const std::uint64_t bytes =
        most.receivers * PathTracer::most_bytes(parameters.bounces, parameters.samples);
    if (parameters.bounces > 0 && bytes > kMaxPathBytes) {
        throw program::UsageError(fmt::format(
            "samples is {}: {} would keep {} MiB of paths, expected at most {} MiB; take fewer "
            "samples, a smaller pool or {}",
            parameters.samples, most.shown, bytes >> 20U, kMaxPathBytes >> 20U, most.remedy));
    }
}

std::uint64_t TracedReceivers::move_to(std::uint32_t first_cluster,
                                       std::uint32_t cluster_count) {
    const std::size_t needed = receivers_.first_in_reach(first_cluster, radius_);
    while (!runs_.empty() && runs_.begin()->first + runs_.begin()->second.size() <= needed) {
        runs_.erase(runs_.begin());
    }
    std::vector<ReceiverRun> missing;
    for (const ReceiverRun& run : receivers_.reach(first_cluster, cluster_count, radius_)) {
        add_missing(run, missing);
    }
    std::atomic<std::uint64_t> rays = 0;
    tbb::parallel_for(std::size_t{0}, missing.size(),
                      [&](std::size_t i) { rays += trace(missing[i]); });
    return rays;
}

void TracedReceivers::add_missing(const ReceiverRun& run, std::vector<ReceiverRun>& missing) {
    for (std::size_t first = run.first; first < run.last;) {
        const auto after = runs_.upper_bound(first);
        if (after != runs_.begin()) {
            const auto& [begin, traced] = *std::prev(after);
            if (first < begin + traced.size()) {
                first = begin + traced.size();
                continue;
            }
        }
        const std::size_t last =
            after == runs_.end() ? run.last : std::min(run.last, after->first);
        runs_.emplace_hint(after, first, std::vector<TracedReceiver>(last - first));
        missing.push_back({.first = first, .last = last});
        first = last;
    }
}

std::uint64_t TracedReceivers::trace(const ReceiverRun& run) {
    std::vector<TracedReceiver>& traced = runs_.at(run.first);
    std::atomic<std::uint64_t> rays = 0;
    constexpr std::size_t kGrain = 16;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(run.first, run.last, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          std::uint64_t cast = 0;
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              TracedReceiver& one = traced[i - run.first];
                              one = tracer_.trace(receivers_.look(i));
                              for (const SurfacePaths& paths : one.paths) {
                                  cast += paths.rays;
                              }
                          }
                          rays += cast;
                      });
    return rays;
}

}  // namespace relume::bake
