#include "server/engine/band_images.h"

#include "server/engine/kernels/accumulate.h"
#include "server/engine/kernels/vector_loops.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace relume::engine {
namespace {

using transport::kBlockSize;
using transport::kColours;

constexpr std::size_t kSumsPerBlock = kColours * kBlockSize;

// The segments of the columns in one shard, weighted; replaces the content of `segments`.
void gather_segments(const transport::Transport& transport,
                     const transport::ShardReader& shard,
                     std::span<const ColumnChange> changes,
                     std::vector<WeightedSegment>& segments) {
    const transport::ColourModel& colour = transport.manifest().colour;
    segments.clear();
    for (const ColumnChange& change : changes) {
        for (std::uint32_t k = 0; k < colour.channels; ++k) {
            const transport::SegmentView segment = shard.segment(change.column, k);
            if (segment.empty()) {
                continue;
            }
            const float step = transport.step(change.column, k);
            WeightedSegment weighted{.segment = segment, .weights = {}};
            for (std::size_t c = 0; c < kColours; ++c) {
                weighted.weights[c] = step * colour.matrix[c][k] * change.amount[c];
            }
            segments.push_back(weighted);
        }
    }
}

}  // namespace

double BandImages::Drift::error() const {
    return std::numeric_limits<float>::epsilon() / 2 * largest_norm * std::sqrt(updates);
}

BandImages::BandImages(const Scene& scene)
    : scene_(&scene),
      bands_(scene.band_count(), std::vector<float>(scene.sum_count())),
      total_(scene.sum_count()),
      drift_(scene.band_count()),
      energies_(scene.transport().shards().size() * scene.band_count()) {}

std::span<float> BandImages::part(std::vector<float>& image, std::size_t shard) const {
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    return std::span(image).subspan(reader.first_block() * kSumsPerBlock,
                                    reader.block_count() * kSumsPerBlock);
}

void BandImages::update(std::uint32_t bands_to_clear, std::span<const ColumnChange> changes) {
    if (bands_to_clear == 0 && changes.empty()) {
        return;
    }
    tbb::parallel_for(std::size_t{0}, scene_->transport().shards().size(),
                      [&](std::size_t shard) { update_shard(shard, bands_to_clear, changes); });
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const bool cleared = ((bands_to_clear >> band) & 1U) != 0;
        if (cleared || !changes_of_band(changes, scene_->bands(), band).empty()) {
            record_drift(band, cleared);
        }
    }
}

void BandImages::rebuild(std::size_t first_shard,
                         std::size_t last_shard,
                         std::span<const ColumnChange> columns) {
    const std::uint32_t all_bands = (1U << bands_.size()) - 1;
    tbb::parallel_for(first_shard, last_shard,
                      [&](std::size_t shard) { update_shard(shard, all_bands, columns); });
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        record_drift(band, true);
    }
}

void BandImages::update_shard(std::size_t shard,
                              std::uint32_t bands_to_clear,
                              std::span<const ColumnChange> changes) {
    for (std::uint32_t band = 0; band < bands_.size(); ++band) {
        const bool clear = ((bands_to_clear >> band) & 1U) != 0;
        const auto of_band = changes_of_band(changes, scene_->bands(), band);
        if (clear || !of_band.empty()) {
            update_band(shard, band, clear, bands_to_clear != 0, of_band);
        }
    }
    if (bands_to_clear != 0) {
        sum_bands(shard);
    }
}

void BandImages::update_band(std::size_t shard,
                             std::uint32_t band,
                             bool clear,
                             bool total_is_resummed,
                             std::span<const ColumnChange> changes) {
    const std::span<float> image = part(bands_[band], shard);
    if (clear) {
        std::fill(image.begin(), image.end(), 0.0F);
    }
    thread_local std::vector<WeightedSegment> segments;
    const transport::ShardReader& reader = scene_->transport().shards()[shard];
    gather_segments(scene_->transport(), reader, changes, segments);
    accumulate_segments(segments, reader.block_count(),
                        {.sums = image.data(),
                         .total = total_is_resummed ? nullptr : part(total_, shard).data()});
    energies_[shard * bands_.size() + band] = squared_norm(image);
}

void BandImages::sum_bands(std::size_t shard) {
    const std::span<float> total = part(total_, shard);
    std::copy_n(part(bands_[0], shard).begin(), total.size(), total.begin());
    for (std::size_t band = 1; band < bands_.size(); ++band) {
        const std::span<const float> image = part(bands_[band], shard);
        for (std::size_t i = 0; i < total.size(); ++i) {
            total[i] += image[i];
        }
    }
}

void BandImages::record_drift(std::uint32_t band, bool cleared) {
    double squared_norm = 0;
    for (std::size_t i = band; i < energies_.size(); i += bands_.size()) {
        squared_norm += energies_[i];
    }
    Drift& drift = drift_[band];
    drift = cleared ? Drift{} : drift;
    drift.largest_norm = std::max(drift.largest_norm, std::sqrt(squared_norm));
    drift.updates += 1;
}

double BandImages::rounding_error() const {
    double sum = 0;
    for (const Drift& drift : drift_) {
        sum += drift.error() * drift.error();
    }
    return std::sqrt(sum);
}

std::uint32_t BandImages::most_drifted_band() const {
    const auto most =
        std::max_element(drift_.begin(), drift_.end(),
                         [](const Drift& a, const Drift& b) { return a.error() < b.error(); });
    return static_cast<std::uint32_t>(most - drift_.begin());
}

}  // namespace relume::engine
