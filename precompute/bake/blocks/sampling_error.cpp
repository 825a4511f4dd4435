#include "precompute/bake/blocks/sampling_error.h"

#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/blocks/sample_tiles.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/path_pool.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/tile_window.h"
#include "protocol/transport/hash.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {
namespace {

constexpr SampleCount kTiles{.every = 32, .least = 12, .most = 48};
constexpr std::uint32_t kPixelSpacing = 4;  // along both sides of a tile
// Along both sides of a pixel, a point in each; the second where surfaces meet.
constexpr std::uint32_t kParts = 2;
constexpr std::uint32_t kEdgeParts = 4;
constexpr std::uint32_t kMorePaths = 4;  // of a point, for no neighbours help
constexpr std::uint32_t kFiner = 8;      // pixels of the finer image along a pixel
constexpr std::size_t kLightsPerKind = 4;
constexpr std::size_t kKinds = 2;  // natural, sun
constexpr std::size_t kLights = kKinds * kLightsPerKind;
// Colours of a pixel under every light.
using PixelLook = std::array<std::array<double, 3>, kLights>;

std::vector<std::vector<float>> lights_for(const basis::CubemapProjection& projection) {
    std::vector<std::vector<float>> lights;
    for (std::uint64_t i = 0; i < kLightsPerKind; ++i) {
        lights.push_back(natural_light(projection.basis(), i));
    }
    for (std::uint64_t i = 0; i < kLightsPerKind; ++i) {
        lights.push_back(sun_light(projection, i));
    }
    return lights;
}

double inner_product(std::span<const float> row, std::span<const float> light) {
    double sum = 0;
    for (std::size_t j = 0; j < row.size(); ++j) {
        sum += double{row[j]} * double{light[j]};
    }
    return sum;
}

PixelLook look_of(const CoefficientRow& row, const std::vector<std::vector<float>>& lights) {
    PixelLook look;
    for (std::size_t i = 0; i < kLights; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            look[i][c] = inner_product(row.rgb[c], lights[i]);
        }
    }
    return look;
}

// Pixels of a tile, kPixelSpacing apart: calls visit(x, y) for each.
template <typename Visit>
void for_each_pixel(const SampleTile& tile, const BakeParameters& parameters, Visit visit) {
    const std::uint32_t right = std::min(tile.left + transport::kTileSide, parameters.width);
    const std::uint32_t bottom = std::min(tile.top + transport::kTileSide, parameters.height);
    for (std::uint32_t y = tile.top + kPixelSpacing / 2; y < bottom; y += kPixelSpacing) {
        for (std::uint32_t x = tile.left + kPixelSpacing / 2; x < right; x += kPixelSpacing) {
            visit(x, y);
        }
    }
}

// What the bake shows.
class BakedLooks {
  public:
    BakedLooks(const RayCaster& caster,
               const scene::Camera& camera,
               const BakeParameters& parameters)
        : caster_(caster),
          camera_(camera),
          parameters_(parameters),
          texels_(parameters.face_resolution, parameters.seed),
          rows_(caster, texels_, parameters_),
          lights_(lights_for(rows_.projection())) {}

    [[nodiscard]] std::vector<PixelLook> look(const SampleTile& tile) const {
        const std::uint32_t right =
            std::min(tile.left + transport::kTileSide, parameters_.width);
        const std::uint32_t bottom =
            std::min(tile.top + transport::kTileSide, parameters_.height);
        TileWindow window(caster_, camera_, parameters_, {.left = tile.left, .right = right});
        (void)window.move_to(tile.top, bottom);
        const PathPool pool(window, parameters_.pool_radius);
        std::vector<PixelLook> looks;
        CoefficientRow row;
        RowBaker::Scratch scratch;
        for_each_pixel(tile, parameters_, [&](std::uint32_t x, std::uint32_t y) {
            PixelLook& look = looks.emplace_back();
            if (!window.pixel(x, y).view.surfaces.empty()) {
                rows_.bake(window.pixel(x, y), x, y, &pool, row, scratch);
                look = look_of(row, lights_);
            }
        });
        return looks;
    }

  private:
    const RayCaster& caster_;
    const scene::Camera& camera_;
    BakeParameters parameters_;
    LightTexels texels_;
    RowBaker rows_;
    std::vector<std::vector<float>> lights_;
};

BakeParameters without_bias(BakeParameters parameters, std::uint64_t number) {
    parameters.width *= kFiner;
    parameters.height *= kFiner;
    parameters.pixel_samples = 1;
    parameters.samples *= kMorePaths;
    parameters.pool_radius = 0;
    parameters.shrinkage = 0;
    parameters.seed = transport::mix_bits(parameters.seed + 1 + number);
    return parameters;
}

// What it would show on average over many bakes that spare nothing: pixels are means over
// pixels of a finer image, each of which is one point, lit by its own rays and paths alone.
class UnbiasedLooks {
  public:
    UnbiasedLooks(const RayCaster& caster,
                  const scene::Camera& camera,
                  const BakeParameters& parameters,
                  std::uint64_t number)
        : caster_(caster),
          pixels_(camera),
          parameters_(parameters),
          finer_(without_bias(parameters, number)),
          camera_(caster.scene().camera, finer_.width, finer_.height),
          texels_(finer_.face_resolution, finer_.seed),
          window_(caster, camera_, finer_, {.left = 0, .right = finer_.width}),
          rows_(caster, texels_, finer_),
          lights_(lights_for(rows_.projection())) {}

    [[nodiscard]] std::vector<PixelLook> look(const SampleTile& tile) const {
        std::vector<PixelLook> looks;
        CoefficientRow row;
        RowBaker::Scratch scratch;
        for_each_pixel(tile, parameters_, [&](std::uint32_t x, std::uint32_t y) {
            PixelLook& sum = looks.emplace_back();
            const std::uint32_t parts = meets_edge(x, y) ? kEdgeParts : kParts;
            const std::uint32_t side = kFiner / parts;
            for (std::uint32_t part = 0; part < parts * parts; ++part) {
                // A pixel of the finer image in each of the parts.
                const std::uint64_t bits = transport::mix_bits(
                    finer_.seed +
                    (std::uint64_t{y} * parameters_.width + x) * kEdgeParts * kEdgeParts +
                    part);
                const std::uint32_t column =
                    x * kFiner + part % parts * side + static_cast<std::uint32_t>(bits) % side;
                const std::uint32_t line = y * kFiner + part / parts * side +
                                           static_cast<std::uint32_t>(bits >> 32U) % side;
                const TracedPixel pixel = window_.trace(column, line);
                if (pixel.view.surfaces.empty()) {
                    continue;
                }
                rows_.bake(pixel, column, line, nullptr, row, scratch);
                const PixelLook one = look_of(row, lights_);
                for (std::size_t i = 0; i < kLights; ++i) {
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[i][c] += one[i][c] / (parts * parts);
                    }
                }
            }
        });
        return looks;
    }

  private:
    [[nodiscard]] bool meets_edge(std::uint32_t x, std::uint32_t y) const {
        const PixelView view =
            view_pixel(caster_, pixels_, x, y, parameters_.pixel_samples, parameters_.seed);
        return view.surfaces.size() > 1 || view.coverage < 1;
    }

    const RayCaster& caster_;
    const scene::Camera& pixels_;
    BakeParameters parameters_;
    BakeParameters finer_;
    scene::Camera camera_;
    LightTexels texels_;
    TileWindow window_;
    RowBaker rows_;
    std::vector<std::vector<float>> lights_;
};

// Σ (B − U₁)·(B − U₂) and Σ U₁·U₂ of one kind of light.
struct Sums {
    double error = 0;
    double energy = 0;

    void add(const std::array<double, 3>& baked,
             const std::array<double, 3>& first,
             const std::array<double, 3>& second) {
        for (std::size_t c = 0; c < 3; ++c) {
            error += (baked[c] - first[c]) * (baked[c] - second[c]);
            energy += first[c] * second[c];
        }
    }
    [[nodiscard]] double relative() const {
        return energy > 0 ? std::sqrt(std::max(error, 0.0) / energy) : 0;
    }
};

}  // namespace

transport::SamplingError measure_sampling_error(const RayCaster& caster,
                                                const scene::Camera& camera,
                                                const BakeParameters& parameters) {
    const BakedLooks baked(caster, camera, parameters);
    const UnbiasedLooks first(caster, camera, parameters, 0);
    const UnbiasedLooks second(caster, camera, parameters, 1);
    const TileWindow window(caster, camera, parameters);
    const std::vector<SampleTile> tiles =
        sample_tiles(window, {.width = parameters.width, .height = parameters.height}, kTiles,
                     parameters.seed);
    std::vector<std::array<Sums, kKinds>> sums(tiles.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        const std::vector<PixelLook> own = baked.look(tiles[i]);
        const std::vector<PixelLook> one = first.look(tiles[i]);
        const std::vector<PixelLook> other = second.look(tiles[i]);
        for (std::size_t p = 0; p < own.size(); ++p) {
            for (std::size_t light = 0; light < kLights; ++light) {
                sums[i][light / kLightsPerKind].add(own[p][light], one[p][light],
                                                    other[p][light]);
            }
        }
    });
    std::array<Sums, kKinds> total;
    for (const std::array<Sums, kKinds>& tile : sums) {
        for (std::size_t kind = 0; kind < kKinds; ++kind) {
            total[kind].error += tile[kind].error;
            total[kind].energy += tile[kind].energy;
        }
    }
    return {.natural = total[0].relative(), .sun = total[1].relative()};
}

}  // namespace relume::bake
