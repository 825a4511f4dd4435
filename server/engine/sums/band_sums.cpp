#include "server/engine/sums/band_sums.h"

#include "server/engine/kernels/vector_loops.h"
#include "server/engine/sums/band_mask.h"

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

constexpr std::size_t kSumsPerBlock = ReceiverSums::kSumsPerBlock;

}  // namespace

BandSums::BandSums(const TransportOperator& of)
    : operator_(&of),
      bands_(of.columns().band_count()),
      total_(of.block_count()),
      loose_(of),
      looked_at_(of.run_count(), 1),
      stale_(of.run_count(), 0),
      drift_(of.columns().band_count() + 1),
      occupied_(of.block_count()),
      energies_(of.block_count() * (of.columns().band_count() + std::size_t{1})) {}

void BandSums::make_band(std::uint32_t band) {
    if (bands_[band].empty()) {
        bands_[band] = ReceiverSums(operator_->block_count());
    }
}

void BandSums::update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes) {
    const Update update{.sums = this, .bands_to_clear = bands_to_clear, .changes = changes};
    update_together({&update, 1});
}

void BandSums::update_together(std::span<const Update> updates) {
    if (updates.empty()) {
        return;
    }
    for (const Update& update : updates) {
        update.sums->begin_update(update);
    }
    const TransportOperator& of = *updates.front().sums->operator_;
    tbb::parallel_for(std::size_t{0}, of.run_count(), [&](std::size_t run) {
        for (const Update& update : updates) {
            update.sums->update_run(run);
        }
    });
    for (const Update& update : updates) {
        update.sums->end_update();
    }
}

void BandSums::look_at(std::vector<std::uint8_t> runs, std::span<const float> approximation) {
    looked_at_ = std::move(runs);
    std::vector<std::size_t> behind;
    for (std::size_t run = 0; run < stale_.size(); ++run) {
        if (stale_[run] != 0 && looked_at_[run] != 0) {
            behind.push_back(run);
        }
    }
    if (behind.empty()) {
        return;
    }
    // Bands hold what the total holds, but for loose columns.
    std::vector<float> held(approximation.begin(), approximation.end());
    const std::size_t count = operator_->columns().count();
    for (const ColumnChange& loose : loose_.columns()) {
        for (std::size_t c = 0; c < kColours; ++c) {
            held[c * count + loose.column] = loose.from[c];
        }
    }
    TransportOperator::Weights in_bands;
    operator_->set_weights(held, in_bands);
    tbb::parallel_for(std::size_t{0}, behind.size(),
                      [&](std::size_t i) { catch_up(behind[i], in_bands); });
}

void BandSums::catch_up(std::size_t run, const TransportOperator::Weights& in_bands) {
    const auto [first, count] = operator_->run(run);
    for (std::uint32_t block = first; block < first + count; ++block) {
        for (std::uint32_t band = 0; band < bands_.size(); ++band) {
            clear_band(block, band);
            if (!bands_[band].empty()) {
                const TransportOperator::Member member{.weights = &in_bands,
                                                       .sums = bands_[band].block(block)};
                operator_->multiply(block, band, {&member, 1});
                occupied_[block] |= operator_->bands_of_block(block) & band_bit(band);
            }
        }
        sum_bands(block);
    }
    operator_->add(run, loose_.columns(), {.sums = total_.block(first)});
    for (std::uint32_t block = first; block < first + count; ++block) {
        measure(block, 2 * total_bit() - 1);
    }
    stale_[run] = 0;
}

void BandSums::begin_update(const Update& update) {
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
    } else if (total.norm_is_unknown()) {
        total.set_norm(measured_norm(bands_.size()));
    }
    loose_.update(step_.begins_anew ? 0 : update.bands_to_clear, update.changes, step_.changes);
    const auto& [total_alone, total_and_band] = step_.changes;
    bytes_added_ = bytes_of(total_alone) + bytes_of(total_and_band);
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const auto changes =
            changes_of_band(total_and_band, operator_->columns().bands(), band);
        if (!changes.empty()) {
            make_band(band);
            if (drift_[band].add(norm_of(changes), changes.size())) {
                step_.images_to_measure |= band_bit(band);
            }
        }
    }
    const bool removes = step_.bands_to_remove != 0 && !step_.begins_anew;
    step_.norm_before = total.norm();
    const std::size_t changes = total_alone.size() + total_and_band.size();
    if (total.add(norm_of(total_alone) + norm_of(total_and_band), changes) || removes) {
        step_.images_to_measure |= total_bit();
    }
    // What is taken back may first have cancelled the image that is removed.
    step_.largest_norm = removes ? total.norm() : 0;
}

void BandSums::update_run(std::size_t run) {
    if (looked_at_[run] == 0) {
        stale_[run] = 1;
        return;
    }
    const auto [first, count] = operator_->run(run);
    if (step_.begins_anew || step_.bands_to_remove != 0) {
        for (std::uint32_t block = first; block < first + count; ++block) {
            remove_bands(block);
        }
    }
    if (!step_.changes.total_alone.empty()) {
        operator_->add(run, step_.changes.total_alone, {.sums = total_.block(first)});
    }
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const auto of_band =
            changes_of_band(step_.changes.total_and_band, operator_->columns().bands(), band);
        if (of_band.empty()) {
            continue;
        }
        std::uint64_t blocks = 0;
        operator_->add(run, of_band,
                       {.sums = bands_[band].block(first),
                        .total = total_.block(first),
                        .occupied = &blocks});
        for_each_bit(blocks, [&, first = first](std::uint32_t block) {
            occupied_[first + block] |= band_bit(band);
        });
    }
    for (std::uint32_t block = first; block < first + count; ++block) {
        measure(block, step_.images_to_measure);
    }
}

void BandSums::end_update() {
    take_measured_norms(step_.images_to_measure);
    unsigned additions = step_.changes.total_alone.empty() ? 0 : 1;
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        if (!changes_of_band(step_.changes.total_and_band, operator_->columns().bands(), band)
                 .empty()) {
            drift_[band].record(1, drift_[band].norm());
            ++additions;
        }
    }
    if (!step_.begins_anew) {
        additions += static_cast<unsigned>(std::popcount(step_.bands_to_remove));
    }
    Drift& total = drift_.back();
    const double largest = std::max({step_.norm_before, step_.largest_norm, total.norm()});
    total.record(additions, largest);
}

void BandSums::rebuild_together(std::uint32_t first_block,
                                std::uint32_t last_block,
                                std::span<const Rebuild> rebuilds) {
    for (const Rebuild& rebuild : rebuilds) {
        BandSums& images = *rebuild.sums;
        for (std::uint32_t band = 0; band < images.bands_.size(); ++band) {
            images.make_band(band);
        }
        images.loose_.clear();
        // They may have been somebody else's.
        std::fill(images.looked_at_.begin(), images.looked_at_.end(), std::uint8_t{1});
        std::fill(images.stale_.begin(), images.stale_.end(), std::uint8_t{0});
        std::fill(images.drift_.begin(), images.drift_.end(), Drift::of_unknown_norm());
    }
    tbb::parallel_for(first_block, last_block,
                      [&](std::uint32_t block) { rebuild_block(block, rebuilds); });
}

void BandSums::rebuild_block(std::uint32_t block, std::span<const Rebuild> rebuilds) {
    const TransportOperator& of = *rebuilds.front().sums->operator_;
    boost::container::small_vector<TransportOperator::Member, kMaxBatchMembers> members;
    for (std::uint32_t band = 0; band < of.columns().band_count(); ++band) {
        members.clear();
        for (const Rebuild& rebuild : rebuilds) {
            rebuild.sums->clear_band(block, band);
            members.push_back(
                {.weights = rebuild.weights, .sums = rebuild.sums->bands_[band].block(block)});
        }
        of.multiply(block, band, std::span(members.data(), members.size()));
    }
    for (const Rebuild& rebuild : rebuilds) {
        BandSums& images = *rebuild.sums;
        images.occupied_[block] = of.bands_of_block(block);
        images.sum_bands(block);
        images.measure(block, images.total_bit());
    }
}

void BandSums::renew_band(std::uint32_t band, const TransportOperator::Weights& weights) {
    make_band(band);
    tbb::parallel_for(std::uint32_t{0}, operator_->block_count(), [&](std::uint32_t block) {
        clear_band(block, band);
        const TransportOperator::Member member{.weights = &weights,
                                               .sums = bands_[band].block(block)};
        operator_->multiply(block, band, {&member, 1});
        occupied_[block] |= operator_->bands_of_block(block) & band_bit(band);
    });
    drift_[band] = Drift::of_unknown_norm();
    loose_.clear(band);
    renew_total();
}

void BandSums::clear_band(std::uint32_t block, std::uint32_t band) {
    if (has_band(occupied_[block], band)) {
        std::fill_n(bands_[band].block(block), kSumsPerBlock, 0.0F);
        occupied_[block] &= ~band_bit(band);
    }
}

void BandSums::remove_bands(std::uint32_t block) {
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

void BandSums::sum_bands(std::uint32_t block) {
    float* total = total_.block(block);
    std::fill_n(total, kSumsPerBlock, 0.0F);
    for_each_bit(occupied_[block], [&](std::uint32_t band) {
        const float* sums = bands_[band].block(block);
        for (std::size_t i = 0; i < kSumsPerBlock; ++i) {
            total[i] += sums[i];
        }
    });
}

void BandSums::measure(std::uint32_t block, std::uint32_t images) {
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

double BandSums::measured_norm(std::size_t image) const {
    double squared_norm = 0;
    for (std::size_t i = image; i < energies_.size(); i += drift_.size()) {
        squared_norm += energies_[i];
    }
    return std::sqrt(squared_norm);
}

void BandSums::take_measured_norms(std::uint32_t images) {
    for_each_bit(images,
                 [&](std::uint32_t image) { drift_[image].set_norm(measured_norm(image)); });
}

// Triangle inequality; of the columns as they are stored.
double BandSums::norm_of(std::span<const ColumnChange> changes) const {
    const std::span<const float> norms =
        operator_->columns().weights(relighting::Priority::transport);
    const std::size_t count = operator_->columns().count();
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

std::uint64_t BandSums::bytes_of(std::span<const ColumnChange> changes) const {
    std::uint64_t bytes = 0;
    for (const ColumnChange& change : changes) {
        bytes += operator_->columns().bytes(change.column);
    }
    return bytes;
}

std::uint64_t BandSums::bytes_of_bands() const {
    std::uint64_t bytes = loose_.columns().size_bytes();
    for (const ReceiverSums& band : bands_) {
        bytes += band.empty() ? 0 : band.sums().size_bytes();
    }
    return bytes;
}

double BandSums::rounding_error_of_total() const {
    return rounding_error(drift_.back().squared_norms());
}

double BandSums::rounding_error_of_bands() const {
    double squared_norms = 0;
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        squared_norms += drift_[band].squared_norms();
    }
    return rounding_error(squared_norms);
}

void BandSums::renew_total() {
    const std::uint32_t all_images = 2 * total_bit() - 1;
    tbb::parallel_for(std::size_t{0}, operator_->run_count(), [&](std::size_t run) {
        if (stale_[run] != 0) {
            return;
        }
        const auto [first, count] = operator_->run(run);
        for (std::uint32_t block = first; block < first + count; ++block) {
            sum_bands(block);
        }
        operator_->add(run, loose_.columns(), {.sums = total_.block(first)});
        for (std::uint32_t block = first; block < first + count; ++block) {
            measure(block, all_images);
        }
    });
    take_measured_norms(all_images);
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        drift_[band].set_cancelled_norm(cancelled_norm(band));
    }
    drift_.back().forget_additions();
}

double BandSums::cancelled_norm(std::uint32_t band) const {
    return std::min(
        drift_[band].norm(),
        norm_of(changes_of_band(loose_.columns(), operator_->columns().bands(), band)));
}

std::uint32_t BandSums::most_drifted_band() const {
    std::uint32_t most = 0;
    for (std::uint32_t band = 1; band < bands_.size(); ++band) {
        if (drift_[band].squared_norms() > drift_[most].squared_norms()) {
            most = band;
        }
    }
    return most;
}

}  // namespace relume::engine
