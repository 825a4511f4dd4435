// What is summed over a column of the stored transport: its energy, its bytes and its sketches.
#pragma once

#include "protocol/transport/manifest.h"
#include "protocol/transport/shard_reader.h"
#include "protocol/transport/sketch_builder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relume::transport {

struct ColumnSummary {
    std::vector<float> energies;              // [N][3]
    std::vector<std::uint32_t> column_bytes;  // [N]
    SketchTable stating;
    SketchTable choosing;
};

// `steps` is [N][K], `tint` [blocks][3][256]. Parallel over columns; the same result on any
// number of threads. The two sketches have independent rows and signs. Throws TransportError
// when a column passes 4 GiB.
[[nodiscard]] ColumnSummary summarise_columns(const Manifest& manifest,
                                              std::span<const ShardReader> shards,
                                              std::span<const float> steps,
                                              std::span<const float> tint);

}  // namespace relume::transport
