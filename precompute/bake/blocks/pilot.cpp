#include "precompute/bake/blocks/pilot.h"

#include "precompute/bake/blocks/colour_split.h"
#include "precompute/bake/blocks/sample_clusters.h"
#include "precompute/bake/blocks/step_chooser.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace relume::bake {
namespace {

// Relative L2 below which one channel under a tint is enough.
constexpr double kColourless = 1e-3;
constexpr std::size_t kLookedAt = 16384;
constexpr std::size_t kChromaReceivers = 128;  // of each group
constexpr SampleCount kPilotClusters{.every = 16, .least = 1, .most = 16};
// Where there is a basis to choose.
constexpr SampleCount kChoosingClusters{.every = 12, .least = 8, .most = 16};

// Receivers of one kind among those looked at, and a few of them spread evenly.
struct ReceiverGroup {
    std::vector<std::size_t> all;

    [[nodiscard]] std::vector<std::size_t> some() const {
        const std::size_t count = std::min(all.size(), kChromaReceivers);
        std::vector<std::size_t> receivers;
        for (std::size_t i = 0; i < count; ++i) {
            receivers.push_back(all[i * all.size() / count]);
        }
        return receivers;
    }
};

// Looks at receivers everywhere. Those in which surfaces meet are few, and it is there that a
// receiver's colour depends on the light: they make a group of their own.
std::array<ReceiverGroup, 2> receiver_groups(const Receivers& receivers) {
    std::array<ReceiverGroup, 2> groups;
    for (const std::size_t receiver : receivers.spread_over_all(kLookedAt)) {
        if (const std::size_t surfaces = receivers.look(receiver).surfaces.size();
            surfaces > 0) {
            groups[surfaces > 1 ? 1 : 0].all.push_back(receiver);
        }
    }
    return groups;
}

struct Scratch {
    std::vector<CoefficientRow> terms;
    ChannelRow channels;
};

// What one channel would lose of the image, as relative L2.
double measure_chroma(const RowSource& rows) {
    tbb::enumerable_thread_specific<Scratch> scratches;
    ChromaResidual total;
    for (const ReceiverGroup& group : receiver_groups(rows.receivers())) {
        const std::vector<std::size_t> some = group.some();
        std::vector<ChromaResidual> residuals(some.size());
        tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t i) {
            Scratch& scratch = scratches.local();
            if (!rows.bake_alone(some[i], scratch.terms)) {
                return;
            }
            for (const CoefficientRow& row : scratch.terms) {
                residuals[i].add(chroma_residual(row));
            }
        });
        const double weight =
            static_cast<double>(group.all.size()) / static_cast<double>(some.size());
        for (const ChromaResidual& residual : residuals) {
            total.add(residual, weight);
        }
    }
    return total.energy > 0 ? std::sqrt(total.residual / total.energy) : 0.0;
}

// Rows of some clusters, of the first channel: the same in both colour models but for a tint of
// the whole row.
StepChooser look_at_clusters(const RowSource& rows, std::uint64_t seed) {
    const Receivers& receivers = rows.receivers();
    const std::vector<std::uint32_t> clusters = sample_clusters(
        receivers, receivers.block_bases().size() > 1 ? kChoosingClusters : kPilotClusters,
        seed);
    std::vector<std::size_t> first_block;
    std::size_t blocks = 0;
    for (const std::uint32_t cluster : clusters) {
        first_block.push_back(blocks);
        blocks += receivers.terms(cluster);
    }
    StepChooser chooser(rows.signals(), blocks);
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(
        std::size_t{0}, clusters.size() * transport::kBlockSize, [&](std::size_t i) {
            const std::size_t cluster = i / transport::kBlockSize;
            const auto slot = static_cast<std::uint32_t>(i % transport::kBlockSize);
            const auto receiver = receivers.receiver_at(clusters[cluster], slot);
            if (!receiver) {
                return;
            }
            Scratch& scratch = scratches.local();
            if (!rows.bake_alone(*receiver, scratch.terms)) {
                return;
            }
            for (std::size_t term = 0; term < scratch.terms.size(); ++term) {
                split_colours(grey_model(), scratch.terms[term], scratch.channels);
                chooser.set_row(first_block[cluster] + term, slot, scratch.channels.channel[0]);
            }
        });
    return chooser;
}

}  // namespace

Quantisation plan_quantisation(const RowSource& rows, std::uint32_t bits, std::uint64_t seed) {
    Quantisation plan;
    plan.chroma_residual = measure_chroma(rows);
    plan.colour = plan.chroma_residual < kColourless ? grey_model() : luma_chroma_model();
    ChosenSteps chosen = look_at_clusters(rows, seed)
                             .choose(bits + rows.signals().further_bits, plan.colour,
                                     rows.receivers().block_bases());
    plan.block_basis = chosen.basis;
    plan.steps = std::move(chosen.steps);
    plan.bytes_of_basis = std::move(chosen.bytes_of_basis);
    return plan;
}

}  // namespace relume::bake
