#include "precompute/bake/blocks/sampling_error.h"

#include "precompute/bake/blocks/light_model.h"
#include "precompute/bake/blocks/sample_blocks.h"
#include "precompute/bake/rows/light_texels.h"
#include "precompute/bake/rows/path_pool.h"
#include "precompute/bake/rows/row_baker.h"
#include "precompute/bake/rows/traced_receivers.h"
#include "protocol/transport/hash.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

constexpr SampleCount kBlocks{.every = 32, .least = 12, .most = 48};
constexpr std::uint32_t kMorePaths = 4;  // of a point, for no neighbours help
constexpr std::size_t kLightsPerKind = 4;
constexpr std::size_t kKinds = 2;  // natural, sun
constexpr std::size_t kLights = kKinds * kLightsPerKind;
// Colours of a receiver under every light.
using LitColours = std::array<std::array<double, 3>, kLights>;

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

LitColours lit_colours(const CoefficientRow& row,
                       const std::vector<std::vector<float>>& lights) {
    LitColours look;
    for (std::size_t i = 0; i < kLights; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            look[i][c] = inner_product(row.rgb[c], lights[i]);
        }
    }
    return look;
}

// What the bake shows.
class BakedLooks {
  public:
    BakedLooks(const RayCaster& caster,
               const Receivers& receivers,
               const BakeParameters& parameters)
        : receivers_(receivers),
          parameters_(parameters),
          texels_(parameters.face_resolution, parameters.seed),
          tracer_(caster, parameters),
          rows_(caster, texels_, parameters),
          lights_(lights_for(rows_.projection())) {}

    [[nodiscard]] std::vector<LitColours> look(std::uint32_t block) const {
        TracedReceivers traced(receivers_, tracer_, parameters_);
        (void)traced.move_to(block, 1);
        const PathPool pool(traced);
        std::vector<LitColours> looks;
        CoefficientRow row;
        RowBaker::Scratch scratch;
        for (const std::size_t receiver : receivers_.spread_over_block(block)) {
            LitColours& look = looks.emplace_back();
            if (!traced.at(receiver).receiver.surfaces.empty()) {
                rows_.bake(traced.at(receiver), &pool, row, scratch);
                look = lit_colours(row, lights_);
            }
        }
        return looks;
    }

  private:
    const Receivers& receivers_;
    BakeParameters parameters_;
    LightTexels texels_;
    PathTracer tracer_;
    RowBaker rows_;
    std::vector<std::vector<float>> lights_;
};

BakeParameters without_bias(BakeParameters parameters, std::uint64_t number) {
    parameters.samples *= kMorePaths;
    parameters.shrinkage = 0;
    parameters.seed = transport::mix_bits(parameters.seed + 1 + number);
    return parameters;
}

// What it would show on average over many bakes that spare nothing: receivers are means over
// points, each of which is lit by its own rays and paths alone.
class UnbiasedLooks {
  public:
    UnbiasedLooks(const RayCaster& caster,
                  const Receivers& receivers,
                  const BakeParameters& parameters,
                  std::uint64_t number)
        : receivers_(receivers),
          parameters_(without_bias(parameters, number)),
          texels_(parameters_.face_resolution, parameters_.seed),
          tracer_(caster, parameters_),
          rows_(caster, texels_, parameters_),
          lights_(lights_for(rows_.projection())) {}

    [[nodiscard]] std::vector<LitColours> look(std::uint32_t block) const {
        std::vector<LitColours> looks;
        CoefficientRow row;
        RowBaker::Scratch scratch;
        for (const std::size_t receiver : receivers_.spread_over_block(block)) {
            LitColours& sum = looks.emplace_back();
            std::vector<Receiver> points = receivers_.points(receiver, parameters_.seed);
            const auto count = static_cast<double>(points.size());
            for (Receiver& point : points) {
                if (point.surfaces.empty()) {
                    continue;
                }
                rows_.bake(tracer_.trace(std::move(point)), nullptr, row, scratch);
                const LitColours one = lit_colours(row, lights_);
                for (std::size_t i = 0; i < kLights; ++i) {
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[i][c] += one[i][c] / count;
                    }
                }
            }
        }
        return looks;
    }

  private:
    const Receivers& receivers_;
    BakeParameters parameters_;
    LightTexels texels_;
    PathTracer tracer_;
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
                                                const Receivers& receivers,
                                                const BakeParameters& parameters) {
    const BakedLooks baked(caster, receivers, parameters);
    const UnbiasedLooks first(caster, receivers, parameters, 0);
    const UnbiasedLooks second(caster, receivers, parameters, 1);
    const std::vector<std::uint32_t> blocks =
        sample_blocks(receivers, kBlocks, parameters.seed);
    std::vector<std::array<Sums, kKinds>> sums(blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        const std::vector<LitColours> own = baked.look(blocks[i]);
        const std::vector<LitColours> one = first.look(blocks[i]);
        const std::vector<LitColours> other = second.look(blocks[i]);
        for (std::size_t p = 0; p < own.size(); ++p) {
            for (std::size_t light = 0; light < kLights; ++light) {
                sums[i][light / kLightsPerKind].add(own[p][light], one[p][light],
                                                    other[p][light]);
            }
        }
    });
    std::array<Sums, kKinds> total;
    for (const std::array<Sums, kKinds>& block : sums) {
        for (std::size_t kind = 0; kind < kKinds; ++kind) {
            total[kind].error += block[kind].error;
            total[kind].energy += block[kind].energy;
        }
    }
    return {.natural = total[0].relative(), .sun = total[1].relative()};
}

}  // namespace relume::bake
