#include "server/engine/cost_model.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace relume::engine {

void CostModel::record_columns(std::uint64_t bytes, double milliseconds) {
    // Fewer bytes than this are mostly overhead and tell little of the rate.
    constexpr std::uint64_t kTellingBytes = 1 << 20U;
    if (bytes >= kTellingBytes) {
        const double newest = milliseconds * 1e6 / static_cast<double>(bytes);
        if (!measured_) {
            nanoseconds_per_byte_ = timing::RunningMean(newest);
            measured_ = true;
        }
        nanoseconds_per_byte_.add(newest);
    }
}

void CostModel::record_overhead(double milliseconds) {
    overhead_milliseconds_.add(milliseconds);
}

std::uint64_t CostModel::bytes_within(double milliseconds, std::size_t sessions) const {
    const auto count = static_cast<double>(sessions);
    const double rounds = std::max(1.0, count / tbb::this_task_arena::max_concurrency());
    const double choosing = rounds * overhead_milliseconds_.mean();
    // However dear it is to choose, as much time goes into what is chosen.
    const double for_columns = std::max(milliseconds - choosing, choosing) / count;
    return static_cast<std::uint64_t>(for_columns * 1e6 / nanoseconds_per_byte_.mean());
}

}  // namespace relume::engine
