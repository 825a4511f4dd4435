#include "server/engine/choosing/ranking.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::engine {

using transport::kColours;

void Ranking::rank(const ColumnTable& table,
                   const SignalState& signal,
                   std::span<const float> weights) {
    const std::span<const BandChunk> chunks = table.band_chunks();
    as_shown_.resize(table.count());
    from_nothing_.resize(table.count());
    chunks_.resize(chunks.size());
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
        chunks_[i] = rank_chunk(table, signal, weights, chunks[i]);
    });
    bands_.fill({});
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        Summary& band = bands_[chunks[i].band];
        band.from_nothing += chunks_[i].from_nothing;
        band.as_shown += chunks_[i].as_shown;
        band.wanted += chunks_[i].wanted;
        band.differing += chunks_[i].differing;
    }
    bands_nearer_from_nothing_ = 0;
    for (std::uint32_t band = 0; band < table.band_count(); ++band) {
        if (bands_[band].from_nothing < bands_[band].as_shown) {
            bands_nearer_from_nothing_ |= 1U << band;
        }
    }
}

Ranking::Summary Ranking::rank_chunk(const ColumnTable& table,
                                     const SignalState& signal,
                                     std::span<const float> weights,
                                     const BandChunk& chunk) {
    const std::size_t count = table.count();
    const std::span<const float> target = signal.target();
    const std::span<const float> approximation = signal.approximation();
    // Not finite where signal of 10¹⁹ is squared; kept finite so that all can be compared.
    const auto finite = [](float importance) {
        constexpr float kLargest = std::numeric_limits<float>::max();
        return importance <= kLargest ? importance : kLargest;
    };
    Summary summary;
    for (std::size_t place = chunk.first; place < chunk.last; ++place) {
        const std::size_t column = table.by_band()[place];
        float shown = 0;
        float nothing = 0;
        bool is_wanted = false;
        bool differs = false;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t i = c * count + column;
            const float wanted = target[i];
            const float difference = wanted - approximation[i];
            is_wanted = is_wanted || wanted != 0;
            differs = differs || wanted != approximation[i];
            nothing += weights[i] * wanted * (weights[i] * wanted);
            shown += weights[i] * difference * (weights[i] * difference);
            summary.from_nothing += double{std::abs(wanted)};
            summary.as_shown += double{std::abs(difference)};
        }
        from_nothing_[place] = is_wanted ? finite(nothing) : kNoDifference;
        as_shown_[place] = differs ? finite(shown) : kNoDifference;
        summary.wanted += is_wanted ? 1 : 0;
        summary.differing += differs ? 1 : 0;
    }
    return summary;
}

std::uint32_t Ranking::differing_columns(std::uint32_t bands_to_reset) const {
    std::uint32_t columns = 0;
    for (std::size_t band = 0; band < bands_.size(); ++band) {
        const bool reset = ((bands_to_reset >> band) & 1U) != 0;
        columns += reset ? bands_[band].wanted : bands_[band].differing;
    }
    return columns;
}

void Ranking::shortlist(const ColumnTable& table,
                        const SelectionBudget& budget,
                        std::vector<std::uint32_t>& places) {
    buckets_.clear();
    for (std::size_t place = 0; place < as_shown_.size(); ++place) {
        const float lesser = std::min(as_shown_[place], from_nothing_[place]);
        if (lesser != kNoDifference) {
            const std::uint32_t column = table.by_band()[place];
            buckets_.add(lesser, table.bytes(column));
        }
    }
    const float least = buckets_.least_within(budget);
    places.clear();
    for (std::size_t place = 0; place < as_shown_.size(); ++place) {
        const float greater = std::max(as_shown_[place], from_nothing_[place]);
        if (greater != kNoDifference && greater >= least) {
            places.push_back(static_cast<std::uint32_t>(place));
        }
    }
}

}  // namespace relume::engine
