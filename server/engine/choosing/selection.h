// The choice of the columns that the next image brings up to date.
#pragma once

#include "server/engine/choosing/importance_buckets.h"
#include "server/engine/choosing/ranking.h"
#include "server/engine/columns/column_table.h"
#include "server/engine/columns/plan.h"
#include "server/engine/columns/signal_state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

// One object serves image after image, so that choosing soon allocates nothing. Not
// thread-safe.
class Selection {
  public:
    // Fills the plan, whose bands to reset are given, with the most important columns; of equal
    // ones the lower index comes first. The first column that does not fit into the budget ends
    // the selection. Only the columns at `places` in ColumnTable::by_band, ascending, are
    // looked at: all of them, or the ranking's shortlist. Linear in their number, because only
    // the columns of the bucket in which the budget ends are sorted.
    void choose(const ColumnTable& table,
                const SignalState& signal,
                const Ranking& ranking,
                std::span<const std::uint32_t> places,
                const SelectionBudget& budget,
                Plan& plan);

  private:
    // A column that differs, and its importance.
    struct Candidate {
        float importance;
        std::uint32_t column;

        [[nodiscard]] bool comes_before(const Candidate& other) const {
            return importance != other.importance ? importance > other.importance
                                                  : column < other.column;
        }
    };

    [[nodiscard]] Candidate last_within(const ColumnTable& table,
                                        const SelectionBudget& budget,
                                        Plan& plan);

    std::vector<Candidate> candidates_;
    std::vector<Candidate> boundary_;
    ImportanceBuckets buckets_;
};

}  // namespace relume::engine
