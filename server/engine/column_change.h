// A column to be added to the image, and how much of it.
#pragma once

#include "protocol/transport/format.h"

#include <array>
#include <cstdint>
#include <span>

namespace relume::engine {

struct ColumnChange {
    std::uint32_t column = 0;
    std::array<float, transport::kColours> amount{};  // ΔL(j,c)

    [[nodiscard]] bool is_nothing() const {
        return amount[0] == 0 && amount[1] == 0 && amount[2] == 0;
    }
};

// The part of `changes`, ordered by band, that belongs to one band.
[[nodiscard]] std::span<const ColumnChange> changes_of_band(
    std::span<const ColumnChange> changes,
    std::span<const std::uint8_t> bands,
    std::uint32_t band);

}  // namespace relume::engine
