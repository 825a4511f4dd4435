#include "tests/bench/quantiser_comparison.h"

#include "precompute/bake/block_encoder.h"

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace relume::bench {
namespace {

using transport::kBlockSize;
using transport::kTileSide;

struct ErrorSums {
    double error = 0;
    double value = 0;
    double gradient_error = 0;
    double gradient = 0;
};

struct TileResult {
    std::uint64_t bytes = 0;
    std::array<ErrorSums, TestLights::kKinds> sums{};
};

// What is stored of one tile: its bytes, and every pixel under every light.
struct StoredTile {
    std::uint64_t bytes = 0;
    std::vector<LitPixel> pixels = std::vector<LitPixel>(kBlockSize);
};

struct QuantisedValue {
    std::uint32_t column = 0;  // j·K + k
    std::int32_t value = 0;
};

// Light of a pixel from its integers.
void light_pixel(const bake::Quantisation& quantisation,
                 const TestLights& lights,
                 const FloatTile::Pixel& pixel,
                 std::span<const QuantisedValue> stored,
                 const std::function<float(std::uint32_t)>& step_of_segment,
                 LitPixel& lit) {
    const std::uint32_t channels = quantisation.colour.channels;
    std::array<std::array<double, 3>, TestLights::kCount> sums{};
    for (const QuantisedValue& value : stored) {
        const double amount =
            double{step_of_segment(value.column)} * static_cast<double>(value.value);
        for (std::size_t light = 0; light < TestLights::kCount; ++light) {
            sums[light][value.column % channels] +=
                amount * double{lights.coefficients[light][value.column / channels]};
        }
    }
    for (std::size_t light = 0; light < TestLights::kCount; ++light) {
        for (std::size_t c = 0; c < 3; ++c) {
            lit[light][c] = 0;
            for (std::size_t k = 0; k < channels; ++k) {
                lit[light][c] += double{pixel.tint[c]} *
                                 double{quantisation.colour.matrix[c][k]} * sums[light][k];
            }
        }
    }
}

// Light of a pixel from its row as stored, [K][N].
void light_pixel(const bake::Quantisation& quantisation,
                 const TestLights& lights,
                 const FloatTile::Pixel& pixel,
                 std::span<const float> row,
                 LitPixel& lit) {
    const std::uint32_t channels = quantisation.colour.channels;
    const std::size_t columns = row.size() / channels;
    for (std::size_t light = 0; light < TestLights::kCount; ++light) {
        lit[light] = {};
        for (std::uint32_t k = 0; k < channels; ++k) {
            const float* values = &row[k * columns];
            double sum = 0;
            for (std::size_t j = 0; j < columns; ++j) {
                sum += double{values[j]} * double{lights.coefficients[light][j]};
            }
            for (std::size_t c = 0; c < 3; ++c) {
                lit[light][c] +=
                    double{pixel.tint[c]} * double{quantisation.colour.matrix[c][k]} * sum;
            }
        }
    }
}

TileResult errors_of(const FloatTile& tile, const StoredTile& stored) {
    TileResult result{.bytes = stored.bytes, .sums = {}};
    for (std::size_t light = 0; light < TestLights::kCount; ++light) {
        ErrorSums& sums = result.sums[light / TestLights::kPerKind];
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value = [&](std::size_t slot) {
                return tile.pixels[slot].exact[light][c];
            };
            const auto error = [&](std::size_t slot) {
                return stored.pixels[slot][light][c] - value(slot);
            };
            const auto add_pair = [&](std::size_t a, std::size_t b) {
                if (tile.pixels[a].covered && tile.pixels[b].covered) {
                    sums.gradient_error += std::pow(error(b) - error(a), 2);
                    sums.gradient += std::pow(value(b) - value(a), 2);
                }
            };
            for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                sums.error += error(slot) * error(slot);
                sums.value += value(slot) * value(slot);
                if (slot % kTileSide + 1 < kTileSide) {
                    add_pair(slot, slot + 1);
                }
                if (slot + kTileSide < kBlockSize) {
                    add_pair(slot, slot + kTileSide);
                }
            }
        }
    }
    return result;
}

StoredTiles store_all(const FloatTiles& tiles,
                      const std::function<StoredTile(const FloatTile&)>& store) {
    std::vector<TileResult> results(tiles.tiles.size());
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
        results[i] = errors_of(tiles.tiles[i], store(tiles.tiles[i]));
    });
    StoredTiles stored;
    for (std::size_t kind = 0; kind < TestLights::kKinds; ++kind) {
        ErrorSums total;
        for (const TileResult& result : results) {
            total.error += result.sums[kind].error;
            total.value += result.sums[kind].value;
            total.gradient_error += result.sums[kind].gradient_error;
            total.gradient += result.sums[kind].gradient;
        }
        stored.errors[kind] = {.l2 = std::sqrt(total.error / total.value),
                               .h1 = std::sqrt(total.gradient_error / total.gradient)};
    }
    for (const TileResult& result : results) {
        stored.bytes += result.bytes;
    }
    return stored;
}

// Raises range[j·K + k] to the largest magnitude in the tile.
void raise_ranges(const FloatTile& tile, std::uint32_t channels, std::vector<float>& range) {
    for (const FloatTile::Pixel& pixel : tile.pixels) {
        for (std::uint32_t k = 0; pixel.covered && k < channels; ++k) {
            for (std::size_t j = 0; j < pixel.channel[k].size(); ++j) {
                float& largest = range[j * channels + k];
                largest = std::max(largest, std::abs(pixel.channel[k][j]));
            }
        }
    }
}

StoredTile store_tile_as_ng03(const FloatTiles& tiles,
                              const FloatTile& tile,
                              const TestLights& lights,
                              std::span<const float> range) {
    constexpr float kLevels = 127;
    constexpr std::uint64_t kEntryBytes = 2;
    const std::uint32_t channels = tiles.quantisation.colour.channels;
    StoredTile stored;
    std::vector<QuantisedValue> values;
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        const FloatTile::Pixel& pixel = tile.pixels[slot];
        if (!pixel.covered) {
            continue;
        }
        values.clear();
        for (std::uint32_t k = 0; k < channels; ++k) {
            for (std::size_t j = 0; j < pixel.channel[k].size(); ++j) {
                const std::size_t segment = j * channels + k;
                const float value = pixel.channel[k][j];
                const auto level =
                    value == 0 ? 0L : std::lround(value / range[segment] * kLevels);
                if (level != 0) {
                    values.push_back({.column = static_cast<std::uint32_t>(segment),
                                      .value = static_cast<std::int32_t>(level)});
                }
            }
        }
        stored.bytes += kEntryBytes * values.size();
        light_pixel(
            tiles.quantisation, lights, pixel, values,
            [&](std::uint32_t segment) { return range[segment] / kLevels; },
            stored.pixels[slot]);
    }
    return stored;
}

std::uint64_t bytes_of_block(const transport::EncodedBlock& block) {
    // Half a byte of tag, and a 64th of an index entry, per segment.
    const std::uint64_t segments = block.segment_count();
    std::uint64_t bytes =
        segments / 2 + segments * sizeof(std::uint32_t) / transport::kMaxBlocksPerShard;
    for (std::size_t segment = 0; segment < segments; ++segment) {
        bytes += block.cell(segment).size();
    }
    return bytes;
}

}  // namespace

nlohmann::json to_json(const StoredTiles& stored) {
    const auto errors = [](const ImageErrors& e) {
        return nlohmann::json{{"l2", e.l2}, {"h1", e.h1}};
    };
    return {{"bytes", stored.bytes},
            {"natural", errors(stored.errors[0])},
            {"sun", errors(stored.errors[1])}};
}

StoredTiles store_as_ng03(const FloatTiles& tiles, const TestLights& lights, Ng03Range range) {
    const std::uint32_t channels = tiles.quantisation.colour.channels;
    std::vector<float> column_range(tiles.quantisation.steps.size());
    for (const FloatTile& tile : tiles.tiles) {
        raise_ranges(tile, channels, column_range);
    }
    return store_all(tiles, [&](const FloatTile& tile) {
        if (range == Ng03Range::column) {
            return store_tile_as_ng03(tiles, tile, lights, column_range);
        }
        std::vector<float> block_range(column_range.size());
        raise_ranges(tile, channels, block_range);
        return store_tile_as_ng03(tiles, tile, lights, block_range);
    });
}

StoredTiles store_as_relume(const FloatTiles& tiles,
                            const TestLights& lights,
                            float step_scale) {
    const bake::Quantisation& quantisation = tiles.quantisation;
    const std::uint32_t channels = quantisation.colour.channels;
    std::vector<float> steps = quantisation.steps;
    for (float& step : steps) {
        step *= step_scale;
    }
    return store_all(tiles, [&](const FloatTile& tile) {
        bake::BlockRows rows(steps.size() / channels, channels);
        bake::StoredRows kept;
        for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
            const FloatTile::Pixel& pixel = tile.pixels[slot];
            for (std::uint32_t k = 0; pixel.covered && k < channels; ++k) {
                rows.set(slot, k, pixel.channel[k]);
            }
            if (pixel.covered) {
                kept.slots.push_back(slot);
            }
        }
        StoredTile stored;
        stored.bytes = bytes_of_block(bake::encode_block(rows, steps, kept));
        for (std::size_t i = 0; i < kept.slots.size(); ++i) {
            const std::uint32_t slot = kept.slots[i];
            light_pixel(quantisation, lights, tile.pixels[slot], kept.rows[i],
                        stored.pixels[slot]);
        }
        return stored;
    });
}

}  // namespace relume::bench
