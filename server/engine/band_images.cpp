#include "server/engine/band_images.h"

#include "server/engine/kernels/vector_loops.h"
#include "server/engine/swept_segments.h"

#include <boost/container/small_vector.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::size_t kSumsPerBlock = kColours * kBlockSize;

std::uint64_t all_blocks(const Scene& scene, std::size_t shard) {
    const std::uint32_t count = scene.transport().shards()[shard].block_count();
    return ~std::uint64_t{0} >> (transport::kMaxBlocksPerShard - count);
}

template <typename Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(static_cast<unsigned>(std::countr_zero(bits)));
    }
}

bool has_band(std::uint32_t bands, std::uint32_t band) {
    return ((bands >> band) & 1U) != 0;
}

}  // namespace

bool BandImages::Drift::add(double norm_of_changes, std::size_t changes) {
    constexpr unsigned kUpdatesUnmeasured = 16;
    constexpr double kLoose = 2;
    // Of few columns the sum of norms says enough; of many, far too much.
    constexpr std::size_t kFewChanges = 64;
    const bool begins = norm == 0 && updates_since == 0;
    norm += norm_of_changes;
    if (begins) {
        known_norm = norm;
        return changes > kFewChanges;
    }
    if (updates_since >= kUpdatesUnmeasured || norm > kLoose * known_norm) {
        return true;
    }
    ++updates_since;
    return false;
}

BandImages::BandImages(const Scene& scene)
    : scene_(&scene),
      bands_(scene.band_count(), std::vector<float>(scene.sum_count())),
      total_(scene.sum_count()),
      drift_(scene.band_count()),
      occupied_(scene.transport().shards().size() * scene.band_count()),
      energies_(scene.transport().shards().size() * scene.band_count()) {}

std::span<float> BandImages::part(std::vector<float>& image, std::size_t shard) const {
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    return std::span(image).subspan(reader.first_block() * kSumsPerBlock,
                                    reader.block_count() * kSumsPerBlock);
}

void BandImages::update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes) {
    const Update update{.images = this, .bands_to_clear = bands_to_clear, .changes = changes};
    update_together({&update, 1});
}

void BandImages::update_together(std::span<const Update> updates) {
    if (updates.empty()) {
        return;
    }
    const Scene& scene = *updates.front().images->scene_;
    boost::container::small_vector<std::uint32_t, kMaxBatchMembers> bands_to_measure;
    for (const Update& update : updates) {
        bands_to_measure.push_back(update.images->begin_update(update));
    }
    tbb::parallel_for(
        std::size_t{0}, scene.transport().shards().size(), [&](std::size_t shard) {
            update_shard(shard, updates, {bands_to_measure.data(), updates.size()});
        });
    for (std::size_t i = 0; i < updates.size(); ++i) {
        updates[i].images->end_update(updates[i], bands_to_measure[i]);
    }
}

std::uint32_t BandImages::begin_update(const Update& update) {
    std::uint32_t bands_to_measure = 0;
    for (std::uint32_t band = 0; band < drift_.size(); ++band) {
        const auto changes = changes_of_band(update.changes, scene_->bands(), band);
        if (has_band(update.bands_to_clear, band)) {
            drift_[band] = {};
        }
        const bool is_unknown = drift_[band].updates_since == ~0U;
        const bool is_loose =
            !changes.empty() && drift_[band].add(norm_of(changes), changes.size());
        bands_to_measure |= (is_unknown || is_loose ? 1U : 0U) << band;
    }
    return bands_to_measure;
}

void BandImages::end_update(const Update& update, std::uint32_t bands_measured) {
    unsigned additions = 0;
    double total_norm = 0;  // not less than the total's
    for (std::uint32_t band = 0; band < drift_.size(); ++band) {
        Drift& drift = drift_[band];
        if (has_band(bands_measured, band)) {
            drift.norm = drift.known_norm = measured_norm(band);
            drift.updates_since = 0;
        }
        if (!changes_of_band(update.changes, scene_->bands(), band).empty()) {
            drift.update_is_done();
            ++additions;
        }
        total_norm += drift.norm;
    }
    total_squared_norms_ = update.bands_to_clear != 0
                               ? 0
                               : total_squared_norms_ + additions * total_norm * total_norm;
}

void BandImages::update_shard(std::size_t shard,
                              std::span<const Update> updates,
                              std::span<const std::uint32_t> bands_to_measure) {
    const Scene& scene = *updates.front().images->scene_;
    SweptSegments& swept = SweptSegments::of_this_thread();
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
        swept.begin();
        for (const Update& update : updates) {
            BandImages& images = *update.images;
            if (has_band(update.bands_to_clear, band)) {
                images.clear_band(shard, band);
            }
            const auto of_band = changes_of_band(update.changes, scene.bands(), band);
            if (!of_band.empty()) {
                float* total = update.bands_to_clear != 0
                                   ? nullptr
                                   : images.part(images.total_, shard).data();
                images.occupied(shard, band) |= gather_changes(
                    scene.transport(), shard, of_band,
                    swept.add({.sums = images.part(images.bands_[band], shard).data(),
                               .total = total}));
            }
        }
        swept.accumulate(scene.transport().shards()[shard].block_count());
        for (std::size_t i = 0; i < updates.size(); ++i) {
            if (has_band(bands_to_measure[i], band)) {
                updates[i].images->measure_energy(shard, band);
            }
        }
    }
    for (const Update& update : updates) {
        if (update.bands_to_clear != 0) {
            update.images->sum_bands(shard);
        }
    }
}

void BandImages::rebuild_together(std::size_t first_shard,
                                  std::size_t last_shard,
                                  std::span<const Rebuild> rebuilds) {
    tbb::parallel_for(first_shard, last_shard,
                      [&](std::size_t shard) { rebuild_shard(shard, rebuilds); });
    for (const Rebuild& rebuild : rebuilds) {
        std::fill(rebuild.images->drift_.begin(), rebuild.images->drift_.end(),
                  Drift::of_unknown_norm());
        rebuild.images->total_squared_norms_ = 0;
    }
}

void BandImages::rebuild_shard(std::size_t shard, std::span<const Rebuild> rebuilds) {
    const Scene& scene = *rebuilds.front().images->scene_;
    SweptSegments& swept = SweptSegments::of_this_thread();
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
        swept.begin();
        for (const Rebuild& rebuild : rebuilds) {
            BandImages& images = *rebuild.images;
            images.clear_band(shard, band);
            images.occupied(shard, band) = all_blocks(scene, shard);
            gather_lighting(scene, shard, band, rebuild.lighting,
                            swept.add({.sums = images.part(images.bands_[band], shard).data(),
                                       .total = nullptr}));
        }
        swept.accumulate(scene.transport().shards()[shard].block_count());
    }
    for (const Rebuild& rebuild : rebuilds) {
        rebuild.images->sum_bands(shard);
    }
}

std::span<float> BandImages::block(std::vector<float>& image,
                                   std::size_t shard,
                                   unsigned block) const {
    return part(image, shard).subspan(block * kSumsPerBlock, kSumsPerBlock);
}

void BandImages::clear_band(std::size_t shard, std::uint32_t band) {
    for_each_bit(occupied(shard, band), [&](unsigned b) {
        const std::span<float> sums = block(bands_[band], shard, b);
        std::fill(sums.begin(), sums.end(), 0.0F);
    });
    occupied(shard, band) = 0;
}

void BandImages::measure_energy(std::size_t shard, std::uint32_t band) {
    double energy = 0;
    for_each_bit(occupied(shard, band),
                 [&](unsigned b) { energy += squared_norm(block(bands_[band], shard, b)); });
    energies_[shard * bands_.size() + band] = energy;
}

// Block by block, so that the total stays in the first-level cache.
void BandImages::sum_bands(std::size_t shard) {
    for_each_bit(all_blocks(*scene_, shard), [&](unsigned b) {
        const std::span<float> total = block(total_, shard, b);
        std::fill(total.begin(), total.end(), 0.0F);
        for (std::uint32_t band = 0; band < bands_.size(); ++band) {
            if (((occupied(shard, band) >> b) & 1U) != 0) {
                const std::span<const float> sums = block(bands_[band], shard, b);
                for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
                    total[i] += sums[i];
                }
            }
        }
    });
}

double BandImages::measured_norm(std::uint32_t band) const {
    double squared_norm = 0;
    for (std::size_t i = band; i < energies_.size(); i += bands_.size()) {
        squared_norm += energies_[i];
    }
    return std::sqrt(squared_norm);
}

// Triangle inequality; of the columns as they are stored.
double BandImages::norm_of(std::span<const ColumnChange> changes) const {
    const std::span<const float> norms = scene_->weights(wire::Priority::transport);
    const std::size_t count = scene_->coefficient_count();
    double sum = 0;
    for (const ColumnChange& change : changes) {
        double squared = 0;
        for (std::size_t c = 0; c < kColours; ++c) {
            const double norm = double{change.amount[c]} * norms[c * count + change.column];
            squared += norm * norm;
        }
        sum += std::sqrt(squared);
    }
    return sum;
}

double BandImages::rounding_error() const {
    double squared_norms = total_squared_norms_;
    for (const Drift& drift : drift_) {
        squared_norms += drift.squared_norms;
    }
    // Half an ε for the additions and half a one for the amounts, which err alike all over the
    // image.
    return std::numeric_limits<float>::epsilon() * std::sqrt(squared_norms);
}

bool BandImages::total_drifted_most() const {
    return total_squared_norms_ > drift_[most_drifted_band()].squared_norms;
}

void BandImages::renew_total() {
    tbb::parallel_for(std::size_t{0}, scene_->transport().shards().size(),
                      [this](std::size_t shard) { sum_bands(shard); });
    total_squared_norms_ = 0;
}

std::uint32_t BandImages::most_drifted_band() const {
    const auto most = std::max_element(
        drift_.begin(), drift_.end(),
        [](const Drift& a, const Drift& b) { return a.squared_norms < b.squared_norms; });
    return static_cast<std::uint32_t>(most - drift_.begin());
}

}  // namespace relume::engine
