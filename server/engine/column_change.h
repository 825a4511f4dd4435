// A column to be added to the image, and how much of it.
#pragma once

#include "protocol/transport/format.h"
#include "server/engine/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::engine {

struct ColumnChange {
    std::uint32_t column = 0;
    std::array<float, transport::kColours> amount{};  // ΔL(j,c)

    [[nodiscard]] bool is_nothing() const {
        return amount[0] == 0 && amount[1] == 0 && amount[2] == 0;
    }
};

// What makes a column of an image of `lighting` (planar [3][N]) from nothing.
[[nodiscard]] inline ColumnChange column_of(const Scene& scene,
                                            std::span<const float> lighting,
                                            std::uint32_t column) {
    const std::size_t count = scene.coefficient_count();
    return {
        .column = column,
        .amount = {lighting[column], lighting[count + column], lighting[2 * count + column]}};
}

// All of a band that makes an image of `lighting` (planar [3][N]) from nothing: its columns
// that are not zero, ordered by index.
[[nodiscard]] std::vector<ColumnChange> changes_from_nothing(const Scene& scene,
                                                             std::span<const float> lighting,
                                                             std::uint32_t band);

// The part of `changes`, ordered by band, that belongs to one band.
[[nodiscard]] std::span<const ColumnChange> changes_of_band(
    std::span<const ColumnChange> changes,
    std::span<const std::uint8_t> bands,
    std::uint32_t band);

}  // namespace relume::engine
