// What is summed over a column of the stored transport: its energy, its bytes and its sketches.
#pragma once

#include "protocol/transport/manifest.h"
#include "protocol/transport/shard_reader.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

struct SketchTable {
    std::vector<float> scales;        // [N][3]
    std::vector<std::int8_t> values;  // [N][3][rows]
};

struct ColumnSummary {
    std::vector<float> energies;              // [N][3]
    std::vector<std::uint32_t> column_bytes;  // [N]
    SketchTable stating;
    SketchTable choosing;
};

// Steps [N][K], tint [blocks][3][256]. Parallel over columns; the same result on any number of
// threads. Throws TransportError when a column passes 4 GiB.
//
// Both are count sketches [Charikar02]: every pixel adds to one row of R with one sign, so one
// costs one addition per non-zero, R times fewer than dense random signs, and the estimate of
// ‖T ΔL‖² it gives is unbiased with relative variance at most 2/R, as theirs. Rows and signs of
// the two are independent.
[[nodiscard]] ColumnSummary summarise_columns(const Manifest& manifest,
                                              std::span<const ShardReader> shards,
                                              std::span<const float> steps,
                                              std::span<const float> tint);

}  // namespace relume::transport
