#include "server/engine/choosing/selection.h"

#include <algorithm>

namespace relume::engine {

void Selection::choose(const ColumnTable& table,
                       const SignalState& signal,
                       const Ranking& ranking,
                       std::span<const std::uint32_t> places,
                       const SelectionBudget& budget,
                       Plan& plan) {
    plan.changes.clear();
    plan.bytes = 0;
    plan.differing_columns = ranking.differing_columns(plan.bands_to_reset);
    candidates_.clear();
    buckets_.clear();
    for (const std::uint32_t place : places) {
        const std::uint32_t column = table.by_band()[place];
        const bool reset = plan.resets(table.bands()[column]);
        const float importance =
            reset ? ranking.from_nothing()[place] : ranking.as_shown()[place];
        if (importance != Ranking::kNoDifference) {
            candidates_.push_back({importance, column});
            buckets_.add(importance, table.bytes(column));
        }
    }
    if (candidates_.empty()) {
        return;
    }
    const Candidate last = last_within(table, budget, plan);
    for (const Candidate& candidate : candidates_) {
        if (!last.comes_before(candidate)) {
            plan.changes.push_back(plan.resets(table.bands()[candidate.column])
                                       ? signal.whole(candidate.column)
                                       : signal.difference(candidate.column));
        }
    }
}

Selection::Candidate Selection::last_within(const ColumnTable& table,
                                            const SelectionBudget& budget,
                                            Plan& plan) {
    const ImportanceBuckets::End end = buckets_.end_of(budget);
    plan.bytes = end.bytes_above;
    boundary_.clear();
    for (const Candidate& candidate : candidates_) {
        if (ImportanceBuckets::bucket_of(candidate.importance) == end.bucket) {
            boundary_.push_back(candidate);
        }
    }
    std::sort(boundary_.begin(), boundary_.end(),
              [](const Candidate& a, const Candidate& b) { return a.comes_before(b); });
    std::uint32_t taken = end.columns_above;
    std::size_t fitting = 0;
    for (; fitting < boundary_.size(); ++fitting) {
        const std::uint32_t bytes = table.bytes(boundary_[fitting].column);
        if (taken > 0 && (taken >= budget.columns || plan.bytes + bytes > budget.bytes)) {
            break;
        }
        ++taken;
        plan.bytes += bytes;
    }
    if (fitting > 0) {
        return boundary_[fitting - 1];
    }
    // All above the bucket: none of it comes after the bucket's upper end.
    constexpr std::uint32_t kAnyColumn = ~std::uint32_t{0};
    return {.importance = end.bucket == ImportanceBuckets::kNone
                              ? 0
                              : ImportanceBuckets::lower_end(end.bucket + 1),
            .column = kAnyColumn};
}

}  // namespace relume::engine
