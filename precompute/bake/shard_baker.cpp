#include "precompute/bake/shard_baker.h"

#include "precompute/bake/block_encoder.h"
#include "precompute/bake/error.h"

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
    BlockEncoder encoder;
    std::span<float> tint;  // [3][256]
    std::array<ErrorMeter::PixelLight, 4> measured{};
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
      meter_(parameters.face_resolution, quantisation) {
    const std::uint32_t channels = quantisation.colour.channels;
    const std::size_t count = quantisation.steps.size() / channels;
    inverse_steps_.assign(channels, std::vector<float>(count));
    for (std::uint32_t k = 0; k < channels; ++k) {
        for (std::size_t j = 0; j < count; ++j) {
            inverse_steps_[k][j] = 1.0F / quantisation.steps[j * channels + k];
        }
    }
}

BakedShard ShardBaker::bake(std::uint32_t first_block,
                            std::uint32_t block_count,
                            const Tick& tick) const {
    BakedShard shard;
    shard.blocks.assign(block_count, transport::EncodedBlock(0));
    constexpr std::size_t kTintValues =
        std::size_t{transport::kColours} * transport::kBlockSize;
    shard.notes.tint.assign(block_count * kTintValues, 1.0F);
    shard.notes.errors.resize(block_count);
    std::atomic<std::uint64_t> rays = 0;
    tbb::parallel_for(std::uint32_t{0}, block_count, [&](std::uint32_t i) {
        std::uint64_t cast = 0;
        shard.blocks[i] = bake_block(
            first_block + i, std::span(shard.notes.tint).subspan(i * kTintValues, kTintValues),
            shard.notes.errors[i], cast, tick);
        rays += cast;
    });
    shard.rays = rays;
    return shard;
}

transport::EncodedBlock ShardBaker::bake_block(std::uint32_t number,
                                               std::span<float> tint,
                                               BlockErrors& errors,
                                               std::uint64_t& rays,
                                               const Tick& tick) const {
    static thread_local Scratch scratch;
    const std::uint32_t left = number % image_.tiles_x() * transport::kTileSide;
    const std::uint32_t top = number / image_.tiles_x() * transport::kTileSide;
    Block block{.number = number, .encoder = {}, .tint = tint};
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
    errors = ErrorMeter::errors(block.measured);
    return block.encoder.encode(quantisation_.steps.size());
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
    const std::uint32_t slot = image_.receiver_from_pixel(x, y).slot;
    for (std::size_t c = 0; c < transport::kColours; ++c) {
        block.tint[c * transport::kBlockSize + slot] =
            scratch.channels.tint[static_cast<int>(c)];
    }
    auto& stored = block.encoder.row(slot);
    const std::uint64_t receiver = std::uint64_t{block.number} * transport::kBlockSize + slot;
    for (std::uint32_t k = 0; k < colour.channels; ++k) {
        transport::quantise_row(scratch.channels.channel[k], inverse_steps_[k], receiver, k,
                                colour.channels, stored);
    }
    if (is_measured_pixel(x, y)) {
        const std::size_t corner = (x % 2 == 0 ? 1U : 0U) + (y % 2 == 0 ? 2U : 0U);
        block.measured[corner] = meter_.measure(scratch.row, scratch.channels.tint, stored);
    }
}

}  // namespace relume::bake
