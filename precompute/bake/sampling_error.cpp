#include "precompute/bake/sampling_error.h"

#include "precompute/bake/light_model.h"
#include "precompute/bake/light_texels.h"
#include "precompute/bake/path_pool.h"
#include "precompute/bake/row_baker.h"
#include "precompute/bake/sample_tiles.h"
#include "precompute/bake/tile_window.h"
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
constexpr std::uint32_t kPixelSpacing = 2;  // along both sides of a tile
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

// The bake with a seed of its own.
class SeededBake {
  public:
    SeededBake(const RayCaster& caster,
               const scene::Camera& camera,
               const BakeParameters& parameters)
        : caster_(caster),
          camera_(camera),
          parameters_(parameters),
          texels_(parameters.face_resolution, parameters.seed),
          rows_(caster, texels_, parameters_),
          lights_(lights_for(rows_.projection())) {}

    // Pixels of a tile, kPixelSpacing apart.
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
        for (std::uint32_t y = tile.top + kPixelSpacing / 2; y < bottom; y += kPixelSpacing) {
            for (std::uint32_t x = tile.left + kPixelSpacing / 2; x < right;
                 x += kPixelSpacing) {
                PixelLook& look = looks.emplace_back();
                if (window.pixel(x, y).view.surfaces.empty()) {
                    continue;
                }
                rows_.bake(window.pixel(x, y), x, y, &pool, row, scratch);
                for (std::size_t i = 0; i < kLights; ++i) {
                    for (std::size_t c = 0; c < 3; ++c) {
                        look[i][c] = inner_product(row.rgb[c], lights_[i]);
                    }
                }
            }
        }
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

// Σ (B₁ − B₂)² / 2 and Σ B₁·B₂ of one kind of light.
struct Sums {
    double variance = 0;
    double energy = 0;

    void add(const std::array<double, 3>& a, const std::array<double, 3>& b) {
        for (std::size_t c = 0; c < 3; ++c) {
            variance += (a[c] - b[c]) * (a[c] - b[c]) / 2;
            energy += a[c] * b[c];
        }
    }
    [[nodiscard]] double relative() const {
        return energy > 0 ? std::sqrt(variance / energy) : 0;
    }
};

BakeParameters with_another_seed(BakeParameters parameters) {
    parameters.seed = transport::mix_bits(parameters.seed + 1);
    return parameters;
}

}  // namespace

transport::SamplingError measure_sampling_error(const RayCaster& caster,
                                                const scene::Camera& camera,
                                                const BakeParameters& parameters) {
    const SeededBake own(caster, camera, parameters);
    const SeededBake other(caster, camera, with_another_seed(parameters));
    const TileWindow window(caster, camera, parameters);
    const std::vector<SampleTile> tiles =
        sample_tiles(window, {.width = parameters.width, .height = parameters.height}, kTiles,
                     parameters.seed);
    std::vector<std::array<Sums, kKinds>> sums(tiles.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
        const std::vector<PixelLook> first = own.look(tiles[i]);
        const std::vector<PixelLook> second = other.look(tiles[i]);
        for (std::size_t p = 0; p < first.size(); ++p) {
            for (std::size_t light = 0; light < kLights; ++light) {
                sums[i][light / kLightsPerKind].add(first[p][light], second[p][light]);
            }
        }
    });
    std::array<Sums, kKinds> total;
    for (const std::array<Sums, kKinds>& tile : sums) {
        for (std::size_t kind = 0; kind < kKinds; ++kind) {
            total[kind].variance += tile[kind].variance;
            total[kind].energy += tile[kind].energy;
        }
    }
    return {.natural = total[0].relative(), .sun = total[1].relative()};
}

}  // namespace relume::bake
