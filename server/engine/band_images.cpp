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

using transport::kColours;

constexpr std::size_t kSumsPerBlock = SumImage::kSumsPerBlock;

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

// Half an ε for the additions and half a one for the amounts, which err alike all over the
// image.
double error_from(double squared_norms) {
    return std::numeric_limits<float>::epsilon() * std::sqrt(squared_norms);
}

}  // namespace

void BandImages::Drift::set_norm(double measured) {
    norm = known_norm = measured;
    updates_since = 0;
}

bool BandImages::Drift::add(double norm_of_changes, std::size_t changes) {
    constexpr unsigned kUpdatesUnmeasured = 16;
    constexpr double kLoose = 2;
    // Of few columns the sum of norms says enough; of many, far too much.
    constexpr std::size_t kFewChanges = 64;
    if (is_unknown()) {
        return true;
    }
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
      bands_(scene.band_count()),
      total_(scene.block_count()),
      loose_(scene),
      drift_(scene.band_count() + 1),
      occupied_(scene.block_count()),
      energies_(scene.block_count() * (scene.band_count() + std::size_t{1})) {}

void BandImages::make_band(std::uint32_t band) {
    if (bands_[band].empty()) {
        bands_[band] = SumImage(scene_->block_count());
    }
}

void BandImages::update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes) {
    const Update update{.images = this, .bands_to_clear = bands_to_clear, .changes = changes};
    update_together({&update, 1});
}

void BandImages::update_together(std::span<const Update> updates) {
    if (updates.empty()) {
        return;
    }
    for (const Update& update : updates) {
        update.images->begin_update(update);
    }
    const Scene& scene = *updates.front().images->scene_;
    tbb::parallel_for(std::size_t{0}, scene.transport().shards().size(),
                      [&](std::size_t shard) {
                          for (const Update& update : updates) {
                              update.images->update_shard(shard);
                          }
                      });
    for (const Update& update : updates) {
        update.images->end_update();
    }
}

void BandImages::begin_update(const Update& update) {
    step_.begins_anew = update.bands_to_clear == total_bit() - 1;
    step_.bands_to_remove = 0;
    step_.images_to_measure = 0;
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        if (has_band(update.bands_to_clear, band)) {
            step_.bands_to_remove |= bands_[band].empty() ? 0 : band_bit(band);
            drift_[band] = {};
        }
    }
    Drift& total = drift_.back();
    if (step_.begins_anew) {
        loose_.clear();
        total = {};
    } else if (total.is_unknown()) {
        total.set_norm(measured_norm(bands_.size()));
    }
    loose_.update(step_.begins_anew ? 0 : update.bands_to_clear, update.changes, step_.changes);
    const auto& [total_alone, total_and_band] = step_.changes;
    bytes_added_ = bytes_of(total_alone) + bytes_of(total_and_band);
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const auto changes = changes_of_band(total_and_band, scene_->bands(), band);
        if (!changes.empty()) {
            make_band(band);
            if (drift_[band].add(norm_of(changes), changes.size())) {
                step_.images_to_measure |= band_bit(band);
            }
        }
    }
    const bool removes = step_.bands_to_remove != 0 && !step_.begins_anew;
    step_.norm_before = total.norm;
    const std::size_t changes = total_alone.size() + total_and_band.size();
    if (total.add(norm_of(total_alone) + norm_of(total_and_band), changes) || removes) {
        step_.images_to_measure |= total_bit();
    }
    // What is taken back may first have cancelled the image that is removed.
    step_.largest_norm = removes ? total.norm : 0;
}

void BandImages::update_shard(std::size_t shard) {
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    const std::uint32_t first = reader.first_block();
    const std::uint32_t count = reader.block_count();
    if (step_.begins_anew || step_.bands_to_remove != 0) {
        for (std::uint32_t block = first; block < first + count; ++block) {
            remove_bands(block);
        }
    }
    thread_local std::vector<WeightedSegment> segments;
    gather_segments(scene_->transport(), shard, step_.changes.total_alone, segments);
    accumulate_segments(segments, count, {.sums = total_.block(first), .total = nullptr});
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const auto of_band =
            changes_of_band(step_.changes.total_and_band, scene_->bands(), band);
        if (of_band.empty()) {
            continue;
        }
        gather_segments(scene_->transport(), shard, of_band, segments);
        for_each_bit(occupied_blocks(segments, count),
                     [&](std::uint32_t b) { occupied_[first + b] |= band_bit(band); });
        accumulate_segments(segments, count,
                            {.sums = bands_[band].block(first), .total = total_.block(first)});
    }
    for (std::uint32_t block = first; block < first + count; ++block) {
        measure(block, step_.images_to_measure);
    }
}

void BandImages::end_update() {
    take_measured_norms(step_.images_to_measure);
    unsigned additions = step_.changes.total_alone.empty() ? 0 : 1;
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        if (!changes_of_band(step_.changes.total_and_band, scene_->bands(), band).empty()) {
            drift_[band].squared_norms += drift_[band].norm * drift_[band].norm;
            ++additions;
        }
    }
    if (!step_.begins_anew) {
        additions += static_cast<unsigned>(std::popcount(step_.bands_to_remove));
    }
    Drift& total = drift_.back();
    const double largest = std::max({step_.norm_before, step_.largest_norm, total.norm});
    total.squared_norms += additions * largest * largest;
}

void BandImages::rebuild_together(std::uint32_t first_block,
                                  std::uint32_t last_block,
                                  std::span<const Rebuild> rebuilds) {
    for (const Rebuild& rebuild : rebuilds) {
        BandImages& images = *rebuild.images;
        for (std::uint32_t band = 0; band < images.bands_.size(); ++band) {
            images.make_band(band);
        }
        images.loose_.clear();
        std::fill(images.drift_.begin(), images.drift_.end(), Drift::of_unknown_norm());
    }
    tbb::parallel_for(first_block, last_block,
                      [&](std::uint32_t block) { rebuild_block(block, rebuilds); });
}

void BandImages::rebuild_block(std::uint32_t block, std::span<const Rebuild> rebuilds) {
    const Scene& scene = *rebuilds.front().images->scene_;
    boost::container::small_vector<StripMatrix::Member, kMaxBatchMembers> members;
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
        members.clear();
        for (const Rebuild& rebuild : rebuilds) {
            rebuild.images->clear_band(block, band);
            members.push_back({.weights = rebuild.weights,
                               .sums = rebuild.images->bands_[band].block(block)});
        }
        scene.strips().multiply(block, band, std::span(members.data(), members.size()));
    }
    for (const Rebuild& rebuild : rebuilds) {
        BandImages& images = *rebuild.images;
        images.occupied_[block] = scene.strips().bands_of_block(block);
        images.sum_bands(block);
        images.measure(block, images.total_bit());
    }
}

void BandImages::renew_band(std::uint32_t band, const ColumnWeights& weights) {
    make_band(band);
    tbb::parallel_for(std::uint32_t{0}, scene_->block_count(), [&](std::uint32_t block) {
        clear_band(block, band);
        const StripMatrix::Member member{.weights = &weights,
                                         .sums = bands_[band].block(block)};
        scene_->strips().multiply(block, band, {&member, 1});
        occupied_[block] |= scene_->strips().bands_of_block(block) & band_bit(band);
    });
    drift_[band] = Drift::of_unknown_norm();
    loose_.clear(band);
    renew_total();
}

void BandImages::clear_band(std::uint32_t block, std::uint32_t band) {
    if (has_band(occupied_[block], band)) {
        std::fill_n(bands_[band].block(block), kSumsPerBlock, 0.0F);
        occupied_[block] &= ~band_bit(band);
    }
}

void BandImages::remove_bands(std::uint32_t block) {
    float* total = total_.block(block);
    for_each_bit(occupied_[block] & step_.bands_to_remove, [&](std::uint32_t band) {
        float* sums = bands_[band].block(block);
        for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
            total[i] -= sums[i];
            sums[i] = 0;
        }
    });
    occupied_[block] &= ~step_.bands_to_remove;
    if (step_.begins_anew) {
        std::fill_n(total, kSumsPerBlock, 0.0F);
    }
}

void BandImages::sum_bands(std::uint32_t block) {
    float* total = total_.block(block);
    std::fill_n(total, kSumsPerBlock, 0.0F);
    for_each_bit(occupied_[block], [&](std::uint32_t band) {
        const float* sums = bands_[band].block(block);
        for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
            total[i] += sums[i];
        }
    });
}

void BandImages::measure(std::uint32_t block, std::uint32_t images) {
    double* energies = &energies_[block * drift_.size()];
    for_each_bit(images, [&](std::uint32_t image) {
        const bool is_total = image == bands_.size();
        const bool is_dark = !is_total && !has_band(occupied_[block], image);
        energies[image] = is_dark
                              ? 0
                              : squared_norm({(is_total ? total_ : bands_[image]).block(block),
                                              kSumsPerBlock});
    });
}

double BandImages::measured_norm(std::size_t image) const {
    double squared_norm = 0;
    for (std::size_t i = image; i < energies_.size(); i += drift_.size()) {
        squared_norm += energies_[i];
    }
    return std::sqrt(squared_norm);
}

void BandImages::take_measured_norms(std::uint32_t images) {
    for_each_bit(images,
                 [&](std::uint32_t image) { drift_[image].set_norm(measured_norm(image)); });
}

// Triangle inequality; of the columns as they are stored.
double BandImages::norm_of(std::span<const ColumnChange> changes) const {
    const std::span<const float> norms = scene_->weights(relighting::Priority::transport);
    const std::size_t count = scene_->coefficient_count();
    double sum = 0;
    for (const ColumnChange& change : changes) {
        double squared = 0;
        for (std::size_t c = 0; c < kColours; ++c) {
            const double norm = double{change.amount(c)} * norms[c * count + change.column];
            squared += norm * norm;
        }
        sum += std::sqrt(squared);
    }
    return sum;
}

std::uint64_t BandImages::bytes_of(std::span<const ColumnChange> changes) const {
    std::uint64_t bytes = 0;
    for (const ColumnChange& change : changes) {
        bytes += scene_->transport().column_bytes(change.column);
    }
    return bytes;
}

std::uint64_t BandImages::bytes_of_bands() const {
    std::uint64_t bytes = loose_.columns().size_bytes();
    for (const SumImage& band : bands_) {
        bytes += band.empty() ? 0 : band.sums().size_bytes();
    }
    return bytes;
}

double BandImages::rounding_error_of_total() const {
    return error_from(drift_.back().squared_norms);
}

double BandImages::squared_norms_of_band(std::uint32_t band) const {
    const Drift& drift = drift_[band];
    return drift.squared_norms + drift.cancelled_norm * drift.cancelled_norm;
}

double BandImages::rounding_error_of_bands() const {
    double squared_norms = 0;
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        squared_norms += squared_norms_of_band(band);
    }
    return error_from(squared_norms);
}

void BandImages::renew_total() {
    const std::uint32_t all_images = 2 * total_bit() - 1;
    tbb::parallel_for(
        std::size_t{0}, scene_->transport().shards().size(), [&](std::size_t shard) {
            const transport::ShardReader& reader = scene_->transport().shards()[shard];
            const std::uint32_t first = reader.first_block();
            const std::uint32_t end = first + reader.block_count();
            for (std::uint32_t block = first; block < end; ++block) {
                sum_bands(block);
            }
            thread_local std::vector<WeightedSegment> segments;
            gather_segments(scene_->transport(), shard, loose_.columns(), segments);
            accumulate_segments(segments, reader.block_count(),
                                {.sums = total_.block(first), .total = nullptr});
            for (std::uint32_t block = first; block < end; ++block) {
                measure(block, all_images);
            }
        });
    take_measured_norms(all_images);
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        drift_[band].cancelled_norm = cancelled_norm(band);
    }
    drift_.back().squared_norms = 0;
}

double BandImages::cancelled_norm(std::uint32_t band) const {
    return std::min(drift_[band].norm,
                    norm_of(changes_of_band(loose_.columns(), scene_->bands(), band)));
}

std::uint32_t BandImages::most_drifted_band() const {
    std::uint32_t most = 0;
    for (std::uint32_t band = 1; band < bands_.size(); ++band) {
        if (squared_norms_of_band(band) > squared_norms_of_band(most)) {
            most = band;
        }
    }
    return most;
}

}  // namespace relume::engine
