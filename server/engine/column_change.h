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
};

// What makes an image of `lighting` (planar [3][N]) from nothing: its columns that are not
// zero, ordered by band and index. Replaces the content of `columns`.
void gather_columns(const Scene& scene,
                    std::span<const float> lighting,
                    std::vector<ColumnChange>& columns);

// The part of `changes`, ordered by band, that belongs to one band.
[[nodiscard]] std::span<const ColumnChange> changes_of_band(
    std::span<const ColumnChange> changes,
    std::span<const std::uint8_t> bands,
    std::uint32_t band);

}  // namespace relume::engine
