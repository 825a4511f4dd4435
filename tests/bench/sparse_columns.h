// Chosen columns of a scene as the plainest of all lists: where a value stands and what it is.
// What the peers build their own storage from.
#pragma once

#include "server/engine/column_change.h"
#include "server/engine/scene.h"

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace relume::bench {

// A matrix column of a peer: column j, channel k at position(j)·K + k.
class ColumnIndex {
  public:
    ColumnIndex(std::span<const std::uint32_t> columns, std::uint32_t channels);

    [[nodiscard]] std::uint32_t channels() const { return channels_; }
    // Throws std::out_of_range for a column that was not chosen.
    [[nodiscard]] std::size_t position(std::uint32_t column) const {
        return positions_.at(column);
    }

  private:
    std::uint32_t channels_;
    std::unordered_map<std::uint32_t, std::size_t> positions_;
};

// Calls `visit(block in shard, place, integer)` for every non-zero of one segment, in order. A
// place is a coefficient of the block: peers sum in the engine's basis, where there are fewest.
using VisitValue = std::function<void(std::uint32_t, std::uint32_t, float)>;
void for_each_value(const transport::ShardReader& shard,
                    std::uint32_t column,
                    std::uint32_t channel,
                    const VisitValue& visit);

// matrix[c][k]·ΔL(j,c): what channel k of a change counts in each colour, before the step.
[[nodiscard]] std::array<float, transport::kColours> channel_weights(
    const engine::Scene& scene, const engine::ColumnChange& change, std::uint32_t channel);

}  // namespace relume::bench
