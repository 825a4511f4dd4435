#include "precompute/bake/blocks/cluster_sample.h"

#include "protocol/transport/hash.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace relume::bake {
namespace {

// Variance of what a bake is off by: as a part of the squared difference to a neighbour, and of
// the squared brightness, as bakes of the built-in scenes have them.
constexpr double kOfDifference = 0.05;
constexpr double kOfBrightness = 0.0008;
constexpr double kAnyone = 0.1;  // part of the draws

double squared(double value) {
    return value * value;
}

// By kind of light.
using Likely = std::array<double, kSignalKinds>;

template <typename ErrorOf>
Likely sum_by_kind(ErrorOf error_of) {
    Likely sums{};
    for (std::size_t i = 0; i < kModelSignals; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            sums[i / kSignalsPerKind] += error_of(i, c);
        }
    }
    return sums;
}

Likely likely_error(const Receivers& receivers,
                    std::span<const BakedColours> lit,
                    const BakedColours& of,
                    std::vector<Neighbour>& scratch) {
    receivers.find_neighbours(of.receiver, 1, scratch);
    Likely likely = sum_by_kind([&](std::size_t i, std::size_t c) {
        return kOfBrightness * squared(of.colours[i][c]);
    });
    for (const Neighbour& neighbour : scratch) {
        const auto found = std::lower_bound(
            lit.begin(), lit.end(), neighbour.receiver,
            [](const BakedColours& a, std::uint64_t index) { return a.receiver < index; });
        if (found == lit.end() || found->receiver != neighbour.receiver) {
            continue;
        }
        const Likely difference = sum_by_kind([&](std::size_t i, std::size_t c) {
            return squared(of.colours[i][c] - found->colours[i][c]);
        });
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            likely[kind] +=
                kOfDifference * difference[kind] / static_cast<double>(scratch.size());
        }
    }
    return likely;
}

}  // namespace

ClusterSample sample_cluster(const Receivers& receivers,
                             std::span<const BakedColours> lit,
                             std::uint64_t seed) {
    ClusterSample sample;
    if (lit.empty()) {
        return sample;
    }
    std::vector<Likely> likely;
    std::vector<Neighbour> scratch;
    for (const BakedColours& receiver : lit) {
        likely.push_back(likely_error(receivers, lit, receiver, scratch));
        const Likely energy = sum_by_kind(
            [&](std::size_t i, std::size_t c) { return squared(receiver.colours[i][c]); });
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            sample.kinds[kind].energy += energy[kind];
            sample.kinds[kind].likely += likely.back()[kind];
        }
    }
    // Where nothing is lit by one kind, its part of the draws takes any.
    std::vector<double> probability(lit.size(), 0);
    const auto uniform = 1 / static_cast<double>(lit.size());
    for (std::size_t i = 0; i < lit.size(); ++i) {
        probability[i] = kAnyone * uniform;
        for (std::size_t kind = 0; kind < kSignalKinds; ++kind) {
            const double sum = sample.kinds[kind].likely;
            probability[i] += (1 - kAnyone) / static_cast<double>(kSignalKinds) *
                              (sum > 0 ? likely[i][kind] / sum : uniform);
        }
    }
    std::vector<double> cumulative(lit.size());
    std::partial_sum(probability.begin(), probability.end(), cumulative.begin());
    const double offset = double{transport::unit_float(transport::mix_bits(seed))};
    sample.receiver_count = static_cast<std::uint32_t>(lit.size());
    sample.drawn = ClusterSample::kDraws;
    for (std::size_t draw = 0; draw < ClusterSample::kDraws; ++draw) {
        const double place =
            (static_cast<double>(draw) + offset) / static_cast<double>(ClusterSample::kDraws);
        const auto at = std::lower_bound(cumulative.begin(), cumulative.end() - 1, place);
        const auto index = static_cast<std::size_t>(at - cumulative.begin());
        sample.draws[draw] = {.receiver = lit[index].receiver,
                              .probability = probability[index],
                              .baked = lit[index].colours};
    }
    return sample;
}

}  // namespace relume::bake
