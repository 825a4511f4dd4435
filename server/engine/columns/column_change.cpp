#include "server/engine/columns/column_change.h"

#include <algorithm>

namespace relume::engine {

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
