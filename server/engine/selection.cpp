#include "server/engine/selection.h"

#include <algorithm>
#include <bit>

namespace relume::engine {

template <typename Visit>
void Selection::for_each_candidate(const Scene& scene,
                                   const Ranking& ranking,
                                   const Plan& plan,
                                   const Visit& visit) {
    for (const BandChunk& chunk : scene.band_chunks()) {
        const std::span<const float> importance =
            plan.resets(chunk.band) ? ranking.from_nothing() : ranking.as_shown();
        for (std::size_t place = chunk.first; place < chunk.last; ++place) {
            if (importance[place] != Ranking::kNoDifference) {
                visit(Candidate{std::bit_cast<std::uint32_t>(importance[place]),
                                scene.columns_by_band()[place]});
            }
        }
    }
}

void Selection::choose(const Scene& scene,
                       const Lighting& lighting,
                       const Ranking& ranking,
                       const SelectionBudget& budget,
                       Plan& plan) {
    plan.changes.clear();
    plan.bytes = 0;
    fill_buckets(scene, ranking, plan);
    if (plan.differing_columns == 0) {
        return;
    }
    const Candidate last = last_within(scene, ranking, budget, plan);
    for_each_candidate(scene, ranking, plan, [&](const Candidate& candidate) {
        if (!last.comes_before(candidate)) {
            plan.changes.push_back(plan.resets(scene.bands()[candidate.column])
                                       ? lighting.whole(candidate.column)
                                       : lighting.difference(candidate.column));
        }
    });
}

void Selection::fill_buckets(const Scene& scene, const Ranking& ranking, Plan& plan) {
    buckets_.fill({});
    plan.differing_columns = 0;
    for_each_candidate(scene, ranking, plan, [&](const Candidate& candidate) {
        Bucket& bucket = buckets_[candidate.importance_bits >> kBucketShift];
        bucket.columns += 1;
        bucket.bytes += scene.transport().column_bytes(candidate.column);
        plan.differing_columns += 1;
    });
}

Selection::Candidate Selection::last_within(const Scene& scene,
                                            const Ranking& ranking,
                                            const SelectionBudget& budget,
                                            Plan& plan) {
    std::size_t taken = 0;
    std::size_t bucket = kBuckets;
    while (bucket > 0 && taken + buckets_[bucket - 1].columns <= budget.columns &&
           plan.bytes + buckets_[bucket - 1].bytes <= budget.bytes) {
        --bucket;
        taken += buckets_[bucket].columns;
        plan.bytes += buckets_[bucket].bytes;
    }
    if (bucket == 0) {
        return {.importance_bits = 0, .column = ~std::uint32_t{0}};
    }
    // The budget ends among the columns of the bucket below.
    Candidate last{.importance_bits = static_cast<std::uint32_t>(bucket) << kBucketShift,
                   .column = ~std::uint32_t{0}};
    boundary_.clear();
    for_each_candidate(scene, ranking, plan, [&](const Candidate& candidate) {
        if (candidate.importance_bits >> kBucketShift == bucket - 1) {
            boundary_.push_back(candidate);
        }
    });
    std::sort(boundary_.begin(), boundary_.end(),
              [](const Candidate& a, const Candidate& b) { return a.comes_before(b); });
    for (const Candidate& candidate : boundary_) {
        const std::uint32_t bytes = scene.transport().column_bytes(candidate.column);
        if (taken > 0 && (taken + 1 > budget.columns || plan.bytes + bytes > budget.bytes)) {
            break;
        }
        ++taken;
        plan.bytes += bytes;
        last = candidate;
    }
    return last;
}

}  // namespace relume::engine
