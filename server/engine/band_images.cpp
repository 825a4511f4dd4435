#include "server/engine/band_images.h"

#include "server/engine/column_segments.h"
#include "server/engine/kernels/vector_loops.h"

#include <boost/container/small_vector.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::size_t kSumsPerBlock = kColours * kBlockSize;

template <typename Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1) {
        visit(static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
}

constexpr std::uint32_t band_bit(std::uint32_t band) {
    return std::uint32_t{1} << band;
}

constexpr bool has_band(std::uint32_t bands, std::uint32_t band) {
    return (bands & band_bit(band)) != 0;
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
      occupied_(scene.block_count()),
      energies_(scene.transport().shards().size() * scene.band_count()) {}

float* BandImages::sums_of(std::vector<float>& image, std::uint32_t block) {
    return &image[block * kSumsPerBlock];
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
    const bool all_are_known = std::none_of(drift_.begin(), drift_.end(),
                                            [](const Drift& d) { return d.is_unknown(); });
    total_is_resummed_ = update.bands_to_clear != 0 && !all_are_known;
    const double norm = total_norm();
    total_squared_norms_ += std::popcount(update.bands_to_clear) * norm * norm;
    if (total_is_resummed_ || update.bands_to_clear == band_bit(scene_->band_count()) - 1) {
        total_squared_norms_ = 0;
    }
    std::uint32_t bands_to_measure = 0;
    for (std::uint32_t band = 0; band < drift_.size(); ++band) {
        const auto changes = changes_of_band(update.changes, scene_->bands(), band);
        if (has_band(update.bands_to_clear, band)) {
            drift_[band] = {};
        }
        const bool is_unknown = drift_[band].is_unknown();
        const bool is_loose =
            !changes.empty() && drift_[band].add(norm_of(changes), changes.size());
        bands_to_measure |= (is_unknown || is_loose ? 1U : 0U) << band;
    }
    return bands_to_measure;
}

void BandImages::end_update(const Update& update, std::uint32_t bands_measured) {
    unsigned additions = 0;
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
    }
    if (!total_is_resummed_) {
        total_squared_norms_ += additions * total_norm() * total_norm();
    }
}

double BandImages::total_norm() const {
    return std::accumulate(drift_.begin(), drift_.end(), 0.0,
                           [](double sum, const Drift& drift) { return sum + drift.norm; });
}

void BandImages::update_shard(std::size_t shard,
                              std::span<const Update> updates,
                              std::span<const std::uint32_t> bands_to_measure) {
    for (std::size_t i = 0; i < updates.size(); ++i) {
        BandImages& images = *updates[i].images;
        images.update_bands(shard, updates[i]);
        for_each_bit(bands_to_measure[i],
                     [&](std::uint32_t band) { images.measure_energy(shard, band); });
    }
}

void BandImages::update_bands(std::size_t shard, const Update& update) {
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    const std::uint32_t first = reader.first_block();
    thread_local std::vector<WeightedSegment> segments;
    for_each_bit(update.bands_to_clear, [&](std::uint32_t band) {
        for (std::uint32_t b = 0; b < reader.block_count(); ++b) {
            remove_band(first + b, band);
        }
    });
    for (std::uint32_t band = 0; band < scene_->band_count(); ++band) {
        const auto of_band = changes_of_band(update.changes, scene_->bands(), band);
        if (of_band.empty()) {
            continue;
        }
        for_each_bit(gather_segments(scene_->transport(), shard, of_band, segments),
                     [&](std::uint32_t b) { occupied_[first + b] |= band_bit(band); });
        accumulate_segments(segments, reader.block_count(),
                            {.sums = sums_of(bands_[band], first),
                             .total = total_is_resummed_ ? nullptr : sums_of(total_, first)});
    }
    for (std::uint32_t b = 0; total_is_resummed_ && b < reader.block_count(); ++b) {
        sum_bands(first + b);
    }
}

void BandImages::rebuild_together(std::uint32_t first_block,
                                  std::uint32_t last_block,
                                  std::span<const Rebuild> rebuilds) {
    tbb::parallel_for(first_block, last_block,
                      [&](std::uint32_t block) { rebuild_block(block, rebuilds); });
    for (const Rebuild& rebuild : rebuilds) {
        std::fill(rebuild.images->drift_.begin(), rebuild.images->drift_.end(),
                  Drift::of_unknown_norm());
        rebuild.images->total_squared_norms_ = 0;
    }
}

void BandImages::rebuild_block(std::uint32_t block, std::span<const Rebuild> rebuilds) {
    const Scene& scene = *rebuilds.front().images->scene_;
    boost::container::small_vector<StripMatrix::Member, kMaxBatchMembers> members;
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
        members.clear();
        for (const Rebuild& rebuild : rebuilds) {
            rebuild.images->clear_band(block, band);
            members.push_back({.weights = rebuild.weights,
                               .sums = sums_of(rebuild.images->bands_[band], block)});
        }
        scene.strips().multiply(block, band, std::span(members.data(), members.size()));
    }
    for (const Rebuild& rebuild : rebuilds) {
        rebuild.images->occupied_[block] = scene.strips().bands_of_block(block);
        rebuild.images->sum_bands(block);
    }
}

void BandImages::renew_band(std::uint32_t band, const ColumnWeights& weights) {
    tbb::parallel_for(std::uint32_t{0}, scene_->block_count(), [&](std::uint32_t block) {
        clear_band(block, band);
        const StripMatrix::Member member{.weights = &weights,
                                         .sums = sums_of(bands_[band], block)};
        scene_->strips().multiply(block, band, {&member, 1});
        occupied_[block] |= scene_->strips().bands_of_block(block) & band_bit(band);
        sum_bands(block);
    });
    drift_[band] = Drift::of_unknown_norm();
    total_squared_norms_ = 0;
}

void BandImages::clear_band(std::uint32_t block, std::uint32_t band) {
    if (has_band(occupied_[block], band)) {
        std::fill_n(sums_of(bands_[band], block), kSumsPerBlock, 0.0F);
        occupied_[block] &= ~band_bit(band);
    }
}

void BandImages::remove_band(std::uint32_t block, std::uint32_t band) {
    if (!has_band(occupied_[block], band)) {
        return;
    }
    float* sums = sums_of(bands_[band], block);
    float* total = sums_of(total_, block);
    const bool is_the_last = occupied_[block] == band_bit(band);
    for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
        total[i] = is_the_last ? 0.0F : total[i] - sums[i];
        sums[i] = 0;
    }
    occupied_[block] &= ~band_bit(band);
}

void BandImages::measure_energy(std::size_t shard, std::uint32_t band) {
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    double energy = 0;
    for (std::uint32_t b = 0; b < reader.block_count(); ++b) {
        const std::uint32_t block = reader.first_block() + b;
        if (has_band(occupied_[block], band)) {
            energy += squared_norm({sums_of(bands_[band], block), kSumsPerBlock});
        }
    }
    energies_[shard * bands_.size() + band] = energy;
}

void BandImages::sum_bands(std::uint32_t block) {
    float* total = sums_of(total_, block);
    std::fill_n(total, kSumsPerBlock, 0.0F);
    for_each_bit(occupied_[block], [&](std::uint32_t band) {
        const float* sums = sums_of(bands_[band], block);
        for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
            total[i] += sums[i];
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
    tbb::parallel_for(std::uint32_t{0}, scene_->block_count(),
                      [this](std::uint32_t block) { sum_bands(block); });
    total_squared_norms_ = 0;
}

std::uint32_t BandImages::most_drifted_band() const {
    const auto most = std::max_element(
        drift_.begin(), drift_.end(),
        [](const Drift& a, const Drift& b) { return a.squared_norms < b.squared_norms; });
    return static_cast<std::uint32_t>(most - drift_.begin());
}

}  // namespace relume::engine
