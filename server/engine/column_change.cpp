#include "server/engine/column_change.h"

#include <algorithm>

namespace relume::engine {

using transport::kColours;

void gather_columns(const Scene& scene,
                    std::span<const float> lighting,
                    std::vector<ColumnChange>& columns) {
    const std::size_t count = scene.coefficient_count();
    columns.clear();
    columns.reserve(count);
    for (const std::uint32_t j : scene.columns_by_band()) {
        ColumnChange change{.column = j};
        bool any = false;
        for (std::size_t c = 0; c < kColours; ++c) {
            change.amount[c] = lighting[c * count + j];
            any = any || change.amount[c] != 0;
        }
        if (any) {
            columns.push_back(change);
        }
    }
}

std::span<const ColumnChange> changes_of_band(std::span<const ColumnChange> changes,
                                              std::span<const std::uint8_t> bands,
                                              std::uint32_t band) {
    const auto first = std::partition_point(
        changes.begin(), changes.end(),
        [&](const ColumnChange& change) { return bands[change.column] < band; });
    const auto last = std::partition_point(
        first, changes.end(),
        [&](const ColumnChange& change) { return bands[change.column] == band; });
    return {first, last};
}

}  // namespace relume::engine
