// What two ways of storing the same tiles cost in bytes and in error.
#pragma once

#include "tests/bench/float_tiles.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>

namespace relume::bench {

// Relative errors of images of the tiles: their L2, and the L2 of their gradient.
struct ImageErrors {
    double l2 = 0;
    double h1 = 0;
};

struct StoredTiles {
    std::uint64_t bytes = 0;
    std::array<ImageErrors, TestLights::kKinds> errors{};  // natural, sun
};
[[nodiscard]] nlohmann::json to_json(const StoredTiles& stored);

// [Ng03 §5]: 8 bits over the largest magnitude of a column, rounded to the nearest; two bytes,
// value and index, for what is not zero. What belongs to a block as a whole is not counted. The
// range is that of the tiles (`over_column`), or of each block of a column by itself.
enum class Ng03Range { column, block };
[[nodiscard]] StoredTiles store_as_ng03(const FloatTiles& tiles,
                                        const TestLights& lights,
                                        Ng03Range range);

// As the bake stores them, with all steps times `step_scale`: cells, and the tags and index
// that a full shard would spend on them.
[[nodiscard]] StoredTiles store_as_relume(const FloatTiles& tiles,
                                          const TestLights& lights,
                                          float step_scale);

}  // namespace relume::bench
