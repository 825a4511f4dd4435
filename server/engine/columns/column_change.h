// A column whose part in the image changes, from how much of it to how much.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstdint>
#include <span>

namespace relume::engine {

struct ColumnChange {
    std::uint32_t column = 0;
    // L̃(j,c) before and after. Both, not their difference: floats that come and go in
    // differences do not come back to where they were.
    std::array<float, transport::kColours> from{};
    std::array<float, transport::kColours> to{};

    [[nodiscard]] float amount(std::size_t c) const { return to[c] - from[c]; }
    [[nodiscard]] bool is_nothing() const { return from == to; }
};

// The part of `changes`, ordered by band, that belongs to one band.
[[nodiscard]] std::span<const ColumnChange> changes_of_band(
    std::span<const ColumnChange> changes,
    std::span<const std::uint8_t> bands,
    std::uint32_t band);

}  // namespace relume::engine
