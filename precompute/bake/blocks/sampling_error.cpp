#include "precompute/bake/blocks/sampling_error.h"

#include "precompute/bake/blocks/light_model.h"
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
#include <map>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

constexpr std::size_t kClusterDraws = 48;
constexpr double kAnyone = 0.1;          // part of them
constexpr std::uint32_t kMorePaths = 4;  // of a point, for no neighbours help

BakeParameters with_seed(BakeParameters parameters, std::uint64_t seed) {
    parameters.seed = seed;
    return parameters;
}

BakeParameters without_bias(BakeParameters parameters, std::uint64_t number) {
    parameters.samples *= kMorePaths;
    parameters.shrinkage = 0;
    return with_seed(parameters, transport::mix_bits(parameters.seed + 1 + number));
}

// Rows and paths of receivers by parameters of their own.
struct LightBaker {
    LightBaker(const RayCaster& caster, const BakeParameters& of)
        : parameters(of),
          texels(of.face_resolution, of.seed),
          tracer(caster, parameters),
          rows(caster, texels, parameters) {}

    BakeParameters parameters;
    LightTexels texels;
    PathTracer tracer;
    RowBaker rows;
};

bool fills(const Receiver& receiver) {
    constexpr float kWhole = 0.999F;  // of shares that are rounded
    return receiver.surfaces.size() == 1 && receiver.surfaces.front().share > kWhole;
}

class Rebake {
  public:
    Rebake(const RayCaster& caster,
           const Receivers& receivers,
           const Receivers& other,
           const BakeParameters& parameters)
        : receivers_(receivers),
          other_(other),
          again_(caster, with_seed(parameters, other_seed(parameters))),
          unbiased_{LightBaker(caster, without_bias(parameters, 0)),
                    LightBaker(caster, without_bias(parameters, 1))},
          lights_(light_signals(again_.rows.projection())) {}

    [[nodiscard]] DrawnError error(std::uint32_t cluster, const ClusterSample& sample) const {
        TracedReceivers traced(other_, again_.tracer, again_.parameters);
        (void)traced.move_to(cluster, 1);
        const PathPool pool(traced);
        DrawnError error;
        std::vector<CoefficientRow> terms;
        RowBaker::Scratch scratch;
        for (std::size_t draw = 0; draw < sample.drawn; ++draw) {
            const SampledReceiver& drawn = sample.draws[draw];
            const double weight =
                1 / (drawn.probability * static_cast<double>(ClusterSample::kDraws));
            LitColours again{};
            if (!traced.at(drawn.receiver).receiver.surfaces.empty()) {
                again_.rows.bake(traced.at(drawn.receiver), &pool, terms, scratch);
                again = lights_.colours(terms.front());
            }
            add_products(weight / 2, drawn.baked, again, drawn.baked, again, error.noise);
            if (fills(receivers_.look(drawn.receiver))) {
                add_products(weight, drawn.baked, mean_of_points(drawn.receiver, unbiased_[0]),
                             again, mean_of_points(drawn.receiver, unbiased_[1]), error.bias);
            }
        }
        return error;
    }

  private:
    [[nodiscard]] LitColours mean_of_points(std::size_t receiver,
                                            const LightBaker& from) const {
        LitColours mean{};
        std::vector<Receiver> points = receivers_.points(receiver, from.parameters.seed);
        std::vector<CoefficientRow> terms;
        RowBaker::Scratch scratch;
        for (Receiver& point : points) {
            if (point.surfaces.empty()) {
                continue;
            }
            from.rows.bake(from.tracer.trace(std::move(point)), nullptr, terms, scratch);
            const LitColours one = lights_.colours(terms.front());
            for (std::size_t i = 0; i < kModelSignals; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    mean[i][c] += one[i][c] / static_cast<double>(points.size());
                }
            }
        }
        return mean;
    }

    const Receivers& receivers_;
    const Receivers& other_;
    LightBaker again_;
    std::array<LightBaker, 2> unbiased_;
    ModelSignals lights_;
};

struct ClusterDraw {
    std::uint32_t cluster = 0;
    double probability = 0;
};

// Both kinds of light count alike.
std::vector<ClusterDraw> draw_clusters(std::span<const ClusterSample> clusters,
                                       std::uint64_t seed) {
    std::array<double, kSignalKinds> likely{};
    double receivers = 0;
    for (const ClusterSample& cluster : clusters) {
        receivers += cluster.receiver_count;
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            likely[kind] += cluster.kinds[kind].likely;
        }
    }
    std::vector<ClusterDraw> draws;
    if (receivers == 0) {
        return draws;
    }
    const double offset = double{transport::unit_float(transport::mix_bits(seed))};
    double cumulative = 0;
    for (std::uint32_t i = 0; i < clusters.size(); ++i) {
        const double uniform = clusters[i].receiver_count / receivers;
        double probability = kAnyone * uniform;
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            probability +=
                (1 - kAnyone) / static_cast<double>(kSignalKinds) *
                (likely[kind] > 0 ? clusters[i].kinds[kind].likely / likely[kind] : uniform);
        }
        cumulative += probability;
        while (draws.size() < kClusterDraws && (static_cast<double>(draws.size()) + offset) /
                                                       static_cast<double>(kClusterDraws) <
                                                   cumulative) {
            draws.push_back({.cluster = i, .probability = probability});
        }
    }
    return draws;
}

// The mean of several estimates of one sum, and its standard error.
struct Estimate {
    double mean = 0;
    double deviation = 0;
};

template <typename ValueOf>
Estimate estimate(std::size_t count, ValueOf value_of) {
    const auto n = static_cast<double>(count);
    Estimate result;
    for (std::size_t i = 0; i < count; ++i) {
        result.mean += value_of(i) / n;
    }
    for (std::size_t i = 0; i < count; ++i) {
        result.deviation += std::pow(value_of(i) - result.mean, 2);
    }
    result.deviation = std::sqrt(result.deviation / (n * std::max(1.0, n - 1)));
    return result;
}

}  // namespace

std::uint64_t other_seed(const BakeParameters& parameters) {
    return transport::mix_bits(parameters.seed + 3);
}

void add_products(double weight,
                  const LitColours& a,
                  const LitColours& b,
                  const LitColours& c,
                  const LitColours& d,
                  std::array<double, kSignalKinds>& sums) {
    for (std::size_t i = 0; i < kModelSignals; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            sums[i / kSignalsPerKind] += weight * (a[i][k] - b[i][k]) * (c[i][k] - d[i][k]);
        }
    }
}

transport::SamplingError measure_sampling_error(const DrawnErrorOf& error_of,
                                                std::uint64_t seed,
                                                std::span<const ClusterSample> clusters) {
    const std::vector<ClusterDraw> draws = draw_clusters(clusters, seed);
    std::map<std::uint32_t, DrawnError> errors;
    for (const ClusterDraw& draw : draws) {
        errors.try_emplace(draw.cluster);
    }
    std::vector<std::pair<const std::uint32_t, DrawnError>*> looked_at;
    for (auto& entry : errors) {
        looked_at.push_back(&entry);
    }
    tbb::parallel_for(std::size_t{0}, looked_at.size(), [&](std::size_t i) {
        auto& [cluster, error] = *looked_at[i];
        error = error_of(cluster, clusters[cluster]);
    });
    const auto relative = [&](SignalKind kind) {
        double energy = 0;
        for (const ClusterSample& cluster : clusters) {
            energy += cluster.kinds[kind].energy;
        }
        if (draws.empty() || !(energy > 0)) {
            return 0.0;
        }
        const auto of_draw = [&](std::size_t i) -> const DrawnError& {
            return errors.at(draws[i].cluster);
        };
        const Estimate noise = estimate(draws.size(), [&](std::size_t i) {
            return of_draw(i).noise[kind] / draws[i].probability;
        });
        const Estimate bias = estimate(draws.size(), [&](std::size_t i) {
            return of_draw(i).bias[kind] / draws[i].probability;
        });
        return std::sqrt((noise.mean + std::max(0.0, bias.mean) + noise.deviation) / energy);
    };
    return {.natural = relative(kNatural), .sun = relative(kSun)};
}

transport::SamplingError measure_sampling_error(const RayCaster& caster,
                                                const Receivers& receivers,
                                                const Receivers& other,
                                                const BakeParameters& parameters,
                                                std::span<const ClusterSample> clusters) {
    const Rebake rebake(caster, receivers, other, parameters);
    return measure_sampling_error(
        [&](std::uint32_t cluster, const ClusterSample& sample) {
            return rebake.error(cluster, sample);
        },
        parameters.seed, clusters);
}

}  // namespace relume::bake
