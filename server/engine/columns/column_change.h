// A change of one column: how much of it the image holds before and after.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstdint>
#include <span>

namespace relume::engine {

struct ColumnChange {
    std::uint32_t column = 0;
    // L̃(j,c) before and after, by colour. Both are kept and not their difference: floats to
    // which a difference is added and subtracted again do not return to the value that they
    // had.
    std::array<float, transport::kColours> from{};
    std::array<float, transport::kColours> to{};

    [[nodiscard]] float amount(std::size_t c) const { return to[c] - from[c]; }
    [[nodiscard]] bool is_nothing() const { return from == to; }
};

// Those of `changes`, which are ordered by band, that belong to one band. `bands` has the band
// of every column, [N].
[[nodiscard]] std::span<const ColumnChange> changes_of_band(
    std::span<const ColumnChange> changes,
    std::span<const std::uint8_t> bands,
    std::uint32_t band);

}  // namespace relume::engine
