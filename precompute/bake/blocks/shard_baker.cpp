#include "precompute/bake/blocks/shard_baker.h"

#include "precompute/bake/base/error.h"
#include "precompute/bake/blocks/block_encoder.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>

namespace relume::bake {

struct ShardBaker::Scratch {
    CoefficientRow row;
    ChannelRow channels;
    RowBaker::Scratch rows;
};

struct ShardBaker::Block {
    std::uint32_t number = 0;
    BlockRows& rows;
    std::span<float> tint;  // [3][256]
    // Of the slots in `stored`.
    std::vector<ErrorMeter::PixelLight> measured;
    StoredRows stored;
};

ShardBaker::ShardBaker(const RowBaker& rows,
                       const TileWindow& window,
                       const transport::TileGrid& image,
                       const Quantisation& quantisation,
                       const BakeParameters& parameters)
    : rows_(rows),
      window_(window),
      pool_(window, parameters.pool_radius),
      image_(image),
      quantisation_(quantisation),
      meter_(rows.projection(), quantisation) {}

BakedShard ShardBaker::bake(std::uint32_t first_block,
                            std::uint32_t block_count,
                            const Tick& tick) const {
    BakedShard shard;
    shard.blocks.assign(block_count, transport::EncodedBlock(0));
    constexpr std::size_t kTintValues =
        std::size_t{transport::kColours} * transport::kBlockSize;
    // Receivers without a surface stay black, whatever the block's coefficients say of them.
    shard.notes.tint.assign(block_count * kTintValues, 0.0F);
    shard.notes.errors.resize(block_count);
    std::atomic<std::uint64_t> rays = 0;
    const std::uint32_t channels = quantisation_.colour.channels;
    tbb::enumerable_thread_specific<BlockRows> rows(quantisation_.steps.size() / channels,
                                                    channels);
    tbb::parallel_for(std::uint32_t{0}, block_count, [&](std::uint32_t i) {
        std::uint64_t cast = 0;
        shard.blocks[i] = bake_block(
            first_block + i, std::span(shard.notes.tint).subspan(i * kTintValues, kTintValues),
            rows.local(), shard.notes.errors[i], cast, tick);
        rays += cast;
    });
    shard.rays = rays;
    return shard;
}

transport::EncodedBlock ShardBaker::bake_block(std::uint32_t number,
                                               std::span<float> tint,
                                               BlockRows& rows,
                                               BlockErrors& errors,
                                               std::uint64_t& rays,
                                               const Tick& tick) const {
    static thread_local Scratch scratch;
    const std::uint32_t left = number % image_.tiles_x() * transport::kTileSide;
    const std::uint32_t top = number / image_.tiles_x() * transport::kTileSide;
    rows.clear();
    Block block{.number = number, .rows = rows, .tint = tint, .measured = {}, .stored = {}};
    const std::uint32_t bottom = std::min(top + transport::kTileSide, image_.height);
    const std::uint32_t right = std::min(left + transport::kTileSide, image_.width);
    for (std::uint32_t y = top; y < bottom; ++y) {
        const std::uint64_t before = scratch.rows.direct.visibility.rays;
        for (std::uint32_t x = left; x < right; ++x) {
            bake_pixel(x, y, block, scratch);
        }
        const std::uint64_t cast = scratch.rows.direct.visibility.rays - before;
        rays += cast;
        if (!tick(right - left, cast)) {
            throw BakeInterrupted("stopped before all shards were finished");
        }
    }
    transport::EncodedBlock encoded = encode_block(rows, quantisation_.steps, block.stored);
    errors = measure(block);
    return encoded;
}

void ShardBaker::bake_pixel(std::uint32_t x,
                            std::uint32_t y,
                            Block& block,
                            Scratch& scratch) const {
    const TracedPixel& pixel = window_.pixel(x, y);
    if (pixel.view.surfaces.empty()) {
        return;
    }
    rows_.bake(pixel, x, y, &pool_, scratch.row, scratch.rows);
    const transport::ColourModel& colour = quantisation_.colour;
    split_colours(colour, scratch.row, scratch.channels);
    const std::uint32_t slot = image_.place_from_pixel(x, y).slot;
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        block.tint[c * transport::kBlockSize + slot] =
            scratch.channels.tint[static_cast<int>(c)];
    }
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        block.rows.set(slot, k, scratch.channels.channel[k]);
    }
    if (is_measured_pixel(x, y)) {
        block.stored.slots.push_back(slot);
        meter_.measure_exact(scratch.row, block.measured.emplace_back());
    }
}

BlockErrors ShardBaker::measure(Block& block) const {
    std::array<ErrorMeter::PixelLight, 4> corners{};
    for (std::size_t i = 0; i < block.measured.size(); ++i) {
        const std::uint32_t slot = block.stored.slots[i];
        Imath::V3f tint;
        for (std::size_t c = 0; c < transport::kColours; ++c) {
            tint[static_cast<int>(c)] = block.tint[c * transport::kBlockSize + slot];
        }
        meter_.measure_stored(block.stored.rows[i], tint, block.measured[i]);
        // Measured pixels have odd coordinates on their left and upper sides.
        const std::size_t corner =
            (slot % 2 == 0 ? 1U : 0U) + (slot / transport::kTileSide % 2 == 0 ? 2U : 0U);
        corners[corner] = block.measured[i];
    }
    return ErrorMeter::errors(corners);
}

}  // namespace relume::bake
