#include "tests/bench/float_tiles.h"

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/blocks/light_rows.h"
#include "precompute/bake/receivers/pixel/pixel_receivers.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/scene/builtin.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace relume::bench {
namespace {

class TileSampler {
  public:
    TileSampler(std::string_view scene,
                const bake::BakeParameters& parameters,
                const TestLights& lights)
        : lights_(lights),
          scene_(scene::build_builtin_scene(scene)),
          caster_(scene_),
          receivers_(caster_, parameters),
          texels_(parameters.face_resolution, parameters.seed),
          tracer_(caster_, parameters),
          traced_(receivers_, tracer_, parameters),
          rows_(caster_, texels_, parameters),
          pool_(traced_),
          quantisation_(
              bake::plan_quantisation(bake::LightRows(caster_, receivers_, parameters),
                                      parameters.bits,
                                      parameters.seed)) {}

    [[nodiscard]] const bake::Quantisation& quantisation() const { return quantisation_; }

    // Tile rows must come in ascending order.
    [[nodiscard]] FloatTile sample(std::uint32_t tile_x, std::uint32_t tile_y) {
        const std::uint32_t block = tile_y * receivers_.image().tiles_x() + tile_x;
        traced_.move_to(block, 1);
        const std::uint32_t channels = quantisation_.colour.channels;
        FloatTile tile{.rows = bake::BlockRows(texels_.size(), channels),
                       .pixels = std::vector<FloatTile::Pixel>(transport::kBlockSize)};
        std::vector<bake::ChannelRow> rows(transport::kBlockSize);
        tbb::parallel_for(std::uint32_t{0}, transport::kBlockSize, [&](std::uint32_t slot) {
            if (const auto receiver = receivers_.receiver_at(block, slot)) {
                sample_pixel(traced_.at(*receiver), rows[slot], tile.pixels[slot]);
            }
        });
        for (std::uint32_t slot = 0; slot < transport::kBlockSize; ++slot) {
            for (std::uint32_t k = 0; tile.pixels[slot].covered && k < channels; ++k) {
                tile.rows.set(slot, k, rows[slot].channel[k]);
            }
        }
        return tile;
    }

  private:
    struct Scratch {
        std::vector<bake::CoefficientRow> terms;
        bake::RowBaker::Scratch rows;
    };

    void sample_pixel(const bake::TracedReceiver& traced,
                      bake::ChannelRow& channels,
                      FloatTile::Pixel& pixel) {
        if (traced.receiver.surfaces.empty()) {
            return;
        }
        Scratch& scratch = scratches_.local();
        rows_.bake(traced, &pool_, scratch.terms, scratch.rows);
        bake::split_colours(quantisation_.colour, scratch.terms.front(), channels);
        pixel.covered = true;
        for (std::size_t c = 0; c < 3; ++c) {
            pixel.tint[c] = channels.tint[static_cast<int>(c)];
        }
        for (std::size_t light = 0; light < TestLights::kCount; ++light) {
            const std::vector<float>& radiance = lights_.coefficients[light];
            for (std::size_t c = 0; c < 3; ++c) {
                for (std::size_t j = 0; j < radiance.size(); ++j) {
                    pixel.exact[light][c] +=
                        double{scratch.terms.front().rgb[c][j]} * double{radiance[j]};
                }
            }
        }
    }

    const TestLights& lights_;
    scene::Scene scene_;
    bake::RayCaster caster_;
    bake::PixelReceivers receivers_;
    bake::LightTexels texels_;
    bake::PathTracer tracer_;
    bake::TracedReceivers traced_;
    bake::RowBaker rows_;
    bake::PathPool pool_;
    bake::Quantisation quantisation_;
    tbb::enumerable_thread_specific<Scratch> scratches_;
};

// The middle of part i of `parts` equal ones.
std::uint32_t middle_of(std::uint32_t i, std::uint32_t parts, std::uint32_t whole) {
    return (2 * i + 1) * whole / (2 * parts);
}

}  // namespace

TestLights::TestLights(std::uint32_t face_resolution) {
    const auto projection =
        basis::CubemapProjection::onto(basis::CubemapBasis::haar(face_resolution));
    for (std::size_t i = 0; i < kPerKind; ++i) {
        coefficients[i] = bake::natural_light(projection->basis(), i);
        coefficients[kPerKind + i] = bake::sun_light(*projection, i);
    }
}

FloatTiles sample_tiles(std::string_view builtin_scene,
                        const bake::BakeParameters& parameters,
                        const TestLights& lights,
                        std::uint32_t rows,
                        std::uint32_t columns) {
    TileSampler sampler(builtin_scene, parameters, lights);
    const transport::TileGrid image{.width = parameters.width, .height = parameters.height};
    FloatTiles tiles{.quantisation = sampler.quantisation(), .tiles = {}};
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            tiles.tiles.push_back(sampler.sample(middle_of(column, columns, image.tiles_x()),
                                                 middle_of(row, rows, image.tiles_y())));
        }
    }
    return tiles;
}

}  // namespace relume::bench
