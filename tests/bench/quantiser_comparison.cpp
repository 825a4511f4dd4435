#include "tests/bench/quantiser_comparison.h"

#include "precompute/bake/blocks/block_encoder.h"
#include "protocol/transport/block_basis.h"
#include "tests/bench/sparse_columns.h"

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

// What the channels of a pixel make of it under each light.
using LitChannels = std::array<std::array<double, 3>, TestLights::kCount>;

LitPixel colours_of(const bake::Quantisation& quantisation,
                    const FloatTile::Pixel& pixel,
                    const LitChannels& channels) {
    LitPixel lit{};
    for (std::size_t light = 0; light < TestLights::kCount; ++light) {
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t k = 0; k < quantisation.colour.channels; ++k) {
                lit[light][c] += double{pixel.tint[c]} *
                                 double{quantisation.colour.matrix[c][k]} * channels[light][k];
            }
        }
    }
    return lit;
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
void raise_ranges(const FloatTile& tile, std::vector<float>& range) {
    const std::uint32_t channels = tile.rows.channels();
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        for (std::uint32_t k = 0; tile.pixels[slot].covered && k < channels; ++k) {
            const float* row = tile.rows.row(slot, k);
            for (std::size_t j = 0; j < tile.rows.columns(); ++j) {
                float& largest = range[j * channels + k];
                largest = std::max(largest, std::abs(row[j]));
            }
        }
    }
}

StoredTile store_tile_as_ng03(const FloatTiles& tiles,
                              const FloatTile& tile,
                              const TestLights& lights,
                              std::span<const float> range) {
    constexpr std::uint64_t kEntryBytes = 2;
    const std::uint32_t channels = tile.rows.channels();
    StoredTile stored;
    for (std::uint32_t slot = 0; slot < kBlockSize; ++slot) {
        if (!tile.pixels[slot].covered) {
            continue;
        }
        LitChannels sums{};
        for (std::uint32_t k = 0; k < channels; ++k) {
            const float* row = tile.rows.row(slot, k);
            for (std::size_t j = 0; j < tile.rows.columns(); ++j) {
                const float step = range[j * channels + k] / kNg03Levels;
                const float level = row[j] == 0 ? 0.0F : std::round(row[j] / step);
                if (level == 0) {
                    continue;
                }
                stored.bytes += kEntryBytes;
                for (std::size_t light = 0; light < TestLights::kCount; ++light) {
                    sums[light][k] +=
                        double{level} * double{step} * double{lights.coefficients[light][j]};
                }
            }
        }
        stored.pixels[slot] = colours_of(tiles.quantisation, tile.pixels[slot], sums);
    }
    return stored;
}

// Sums of a block's cells under one light and channel, from the basis of blocks to receivers.
using BlockSums = std::array<float, kBlockSize>;

void light_block(const bake::Quantisation& quantisation,
                 const TestLights& lights,
                 float step_scale,
                 const FloatTile& tile,
                 const transport::EncodedBlock& block,
                 std::vector<LitPixel>& pixels) {
    const std::uint32_t channels = quantisation.colour.channels;
    std::vector<std::array<BlockSums, transport::kMaxChannels>> sums(TestLights::kCount);
    transport::DecodedCell values;
    for (std::size_t segment = 0; segment < block.segment_count(); ++segment) {
        if (block.tag(segment) == transport::CellTag::empty) {
            continue;
        }
        transport::decode_cell(block.tag(segment), block.cell(segment).data(), values);
        const float step = step_scale * quantisation.steps[segment];
        for (std::size_t light = 0; light < TestLights::kCount; ++light) {
            const float weight = step * lights.coefficients[light][segment / channels];
            BlockSums& sum = sums[light][segment % channels];
            for (std::size_t i = 0; i < kBlockSize; ++i) {
                sum[i] += weight * values[i];
            }
        }
    }
    std::vector<LitChannels> lit(kBlockSize);
    for (std::size_t light = 0; light < TestLights::kCount; ++light) {
        for (std::uint32_t k = 0; k < channels; ++k) {
            transport::block_receivers_from_coefficients(transport::BlockBasis::haar_tile,
                                                         sums[light][k]);
            for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
                lit[slot][light][k] = double{sums[light][k][slot]};
            }
        }
    }
    for (std::size_t slot = 0; slot < kBlockSize; ++slot) {
        if (tile.pixels[slot].covered) {
            pixels[slot] = colours_of(quantisation, tile.pixels[slot], lit[slot]);
        }
    }
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
    std::vector<float> column_range(tiles.quantisation.steps.size());
    for (const FloatTile& tile : tiles.tiles) {
        raise_ranges(tile, column_range);
    }
    return store_all(tiles, [&](const FloatTile& tile) {
        if (range == Ng03Range::column) {
            return store_tile_as_ng03(tiles, tile, lights, column_range);
        }
        std::vector<float> block_range(column_range.size());
        raise_ranges(tile, block_range);
        return store_tile_as_ng03(tiles, tile, lights, block_range);
    });
}

StoredTiles store_as_relume(const FloatTiles& tiles,
                            const TestLights& lights,
                            float step_scale) {
    std::vector<float> steps = tiles.quantisation.steps;
    for (float& step : steps) {
        step *= step_scale;
    }
    return store_all(tiles, [&](const FloatTile& tile) {
        StoredTile stored;
        if (tile.rows.present_count() == 0) {
            return stored;
        }
        bake::StoredRows no_rows;
        const transport::EncodedBlock block =
            bake::encode_block(transport::BlockBasis::haar_tile, tile.rows, steps, no_rows);
        light_block(tiles.quantisation, lights, step_scale, tile, block, stored.pixels);
        stored.bytes = bytes_of_block(block);
        return stored;
    });
}

}  // namespace relume::bench
