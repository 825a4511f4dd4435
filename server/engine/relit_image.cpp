#include "server/engine/relit_image.h"

#include "protocol/transport/receiver_basis.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;
using transport::kTileSide;

void write_block(const Scene& scene,
                 std::span<const float> sums,
                 std::uint32_t block,
                 std::span<float> rgb) {
    constexpr std::size_t kSumsPerBlock = std::size_t{kColours} * kBlockSize;
    const std::size_t first = block * kSumsPerBlock;
    std::array<std::array<float, kBlockSize>, kColours> values;  // in Z-order
    for (std::size_t c = 0; c < kColours; ++c) {
        transport::z_ordered_receivers_from_coefficients(
            std::span<const float, kBlockSize>(&sums[first + c * kBlockSize], kBlockSize),
            values[c]);
    }
    const std::span<const float> tint = scene.transport().tint().subspan(first, kSumsPerBlock);
    const transport::TileGrid& image = scene.image();
    const std::uint32_t left = block % image.tiles_x() * kTileSide;
    const std::uint32_t top = block / image.tiles_x() * kTileSide;
    const std::uint32_t columns = std::min(kTileSide, image.width - left);
    const std::uint32_t rows = std::min(kTileSide, image.height - top);
    for (std::uint32_t y = 0; y < rows; ++y) {
        float* out = &rgb[kColours * (std::size_t{top + y} * image.width + left)];
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::size_t slot = y * kTileSide + x;
            for (std::size_t c = 0; c < kColours; ++c) {
                *out++ = values[c][transport::kZOrder[slot]] * tint[c * kBlockSize + slot];
            }
        }
    }
}

}  // namespace

void write_relit_image(const Scene& scene, std::span<const float> sums, std::span<float> rgb) {
    const transport::TileGrid& image = scene.image();
    const std::size_t expected = std::size_t{kColours} * image.width * image.height;
    if (rgb.size() != expected) {
        throw std::invalid_argument(
            fmt::format("image buffer has {} values, expected {}", rgb.size(), expected));
    }
    tbb::parallel_for(std::uint32_t{0}, image.block_count(),
                      [&](std::uint32_t block) { write_block(scene, sums, block, rgb); });
}

}  // namespace relume::engine
