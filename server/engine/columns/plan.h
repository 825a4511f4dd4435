// What the next image changes. A plan is a decision; others carry it out.
#pragma once

#include "server/engine/columns/column_change.h"

#include <cstdint>
#include <vector>

namespace relume::engine {

// First the bands of the mask begin anew (L̃ := 0), then the changes are made. `from` of a
// change is L̃ after the resets.
struct Plan {
    std::uint32_t bands_to_reset = 0;     // bit b: L̃ := 0 in band b
    std::vector<ColumnChange> changes;    // ordered by band and index
    std::uint64_t bytes = 0;              // of the columns of `changes`
    std::uint32_t differing_columns = 0;  // after the resets and before the changes

    [[nodiscard]] bool resets(std::uint32_t band) const {
        return ((bands_to_reset >> band) & 1U) != 0;
    }
    // Columns that will still differ when the plan has been carried out.
    [[nodiscard]] std::uint32_t remaining_columns() const {
        return differing_columns - static_cast<std::uint32_t>(changes.size());
    }
};

}  // namespace relume::engine
