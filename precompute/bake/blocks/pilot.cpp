#include "precompute/bake/blocks/pilot.h"

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/sample_tiles.h"
#include "precompute/bake/blocks/step_chooser.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relume::bake {
namespace {

// Relative L2 below which one channel under a tint is enough.
constexpr double kColourless = 1e-3;
constexpr double kPixelsLookedAt = 16384;
constexpr std::size_t kChromaPixels = 128;  // of each group
constexpr SampleCount kPilotTiles{.every = 16, .least = 1, .most = 16};

struct Pixel {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
};

// Pixels of one kind among those looked at, and a few of them spread evenly.
struct PixelGroup {
    std::vector<Pixel> all;

    [[nodiscard]] std::vector<Pixel> some() const {
        const std::size_t count = std::min(all.size(), kChromaPixels);
        std::vector<Pixel> pixels;
        for (std::size_t i = 0; i < count; ++i) {
            pixels.push_back(all[i * all.size() / count]);
        }
        return pixels;
    }
};

// Looks at pixels all over the image. Those in which surfaces meet are few, and it is there
// that a pixel's colour depends on the light: they make a group of their own.
std::array<PixelGroup, 2> pixel_groups(const TileWindow& window,
                                       const transport::TileGrid& image) {
    const double area = static_cast<double>(image.width) * image.height;
    const auto spacing =
        std::max(1U, static_cast<std::uint32_t>(std::sqrt(area / kPixelsLookedAt)));
    std::array<PixelGroup, 2> groups;
    for (std::uint32_t y = spacing / 2; y < image.height; y += spacing) {
        for (std::uint32_t x = spacing / 2; x < image.width; x += spacing) {
            if (const std::size_t surfaces = window.surface_count(x, y); surfaces > 0) {
                groups[surfaces > 1 ? 1 : 0].all.push_back({x, y});
            }
        }
    }
    return groups;
}

struct Scratch {
    CoefficientRow row;
    ChannelRow channels;
    RowBaker::Scratch rows;
};

// What one channel would lose of the image, as relative L2.
double measure_chroma(const RowBaker& rows,
                      const TileWindow& window,
                      const transport::TileGrid& image) {
    tbb::enumerable_thread_specific<Scratch> scratches;
    ChromaResidual total;
    for (const PixelGroup& group : pixel_groups(window, image)) {
        const std::vector<Pixel> pixels = group.some();
        std::vector<ChromaResidual> residuals(pixels.size());
        tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
            Scratch& scratch = scratches.local();
            const auto [x, y] = pixels[i];
            rows.bake(window.trace(x, y), x, y, nullptr, scratch.row, scratch.rows);
            residuals[i] = chroma_residual(scratch.row);
        });
        const double weight =
            static_cast<double>(group.all.size()) / static_cast<double>(pixels.size());
        for (const ChromaResidual& residual : residuals) {
            total.residual += weight * residual.residual;
            total.energy += weight * residual.energy;
        }
    }
    return total.energy > 0 ? std::sqrt(total.residual / total.energy) : 0.0;
}

// Rows of some tiles, of the first channel: the same in both colour models but for a tint of
// the whole row.
StepChooser look_at_tiles(const RowBaker& rows,
                          const TileWindow& window,
                          const transport::TileGrid& image,
                          const BakeParameters& parameters) {
    const std::vector<SampleTile> tiles =
        sample_tiles(window, image, kPilotTiles, parameters.seed);
    StepChooser chooser(signal_basis(parameters), tiles.size());
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, tiles.size() * transport::kBlockSize, [&](std::size_t i) {
        const std::size_t tile = i / transport::kBlockSize;
        const auto slot = static_cast<std::uint32_t>(i % transport::kBlockSize);
        const std::uint32_t x = tiles[tile].left + slot % transport::kTileSide;
        const std::uint32_t y = tiles[tile].top + slot / transport::kTileSide;
        if (x >= image.width || y >= image.height) {
            return;
        }
        Scratch& scratch = scratches.local();
        rows.bake(window.trace(x, y), x, y, nullptr, scratch.row, scratch.rows);
        split_colours(grey_model(), scratch.row, scratch.channels);
        chooser.set_row(tile, slot, scratch.channels.channel[0]);
    });
    return chooser;
}

}  // namespace

Quantisation plan_quantisation(const RowBaker& rows,
                               const TileWindow& window,
                               const transport::TileGrid& image,
                               const BakeParameters& parameters) {
    Quantisation plan;
    plan.chroma_residual = measure_chroma(rows, window, image);
    plan.colour = plan.chroma_residual < kColourless ? grey_model() : luma_chroma_model();
    plan.steps =
        look_at_tiles(rows, window, image, parameters).steps(parameters.bits, plan.colour);
    return plan;
}

}  // namespace relume::bake
