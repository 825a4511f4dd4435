#include "server/engine/columns/significant_columns.h"

#include "server/engine/kernels/vector_loops.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace relume::engine {

using transport::kColours;

SignificantColumns::SignificantColumns(const ColumnTable& table)
    : table_(&table),
      norms_(kColours * table.count()),
      columns_(norms_.size()),
      counts_(kColours * table.band_chunks().size()) {}

void SignificantColumns::set(std::span<const float> signal) {
    norms_.assign(signal.begin(), signal.end());
    take(signal, 0);
}

void SignificantColumns::set_nearly(std::span<const float> signal, double negligible) {
    const std::span<const float> weights = table_->weights(relighting::Priority::transport);
    for (std::size_t i = 0; i < norms_.size(); ++i) {
        norms_[i] = signal[i] * weights[i];
    }
    const double of_each =
        negligible * std::sqrt(squared_norm(norms_) / static_cast<double>(norms_.size()));
    // SignalState of 10¹⁹ cannot be squared; all of it counts then.
    take(signal, std::isfinite(of_each) ? static_cast<float>(of_each) : 0);
}

void SignificantColumns::take(std::span<const float> signal, float negligible) {
    const std::size_t count = table_->count();
    const std::span<const BandChunk> chunks = table_->band_chunks();
    tbb::parallel_for(std::size_t{0}, kColours * chunks.size(), [&](std::size_t i) {
        const BandChunk& chunk = chunks[i / kColours];
        const std::size_t first = i % kColours * count;
        Column* const columns = &columns_[first + chunk.first];
        std::size_t taken = 0;
        for (std::size_t place = chunk.first; place < chunk.last; ++place) {
            const std::uint32_t column = table_->by_band()[place];
            columns[taken] = {.column = column, .amount = signal[first + column]};
            taken += std::abs(norms_[first + column]) > negligible ? 1U : 0U;
        }
        counts_[i] = taken;
    });
}

std::span<const SignificantColumns::Column> SignificantColumns::of(std::size_t chunk,
                                                                   std::uint32_t colour) const {
    return std::span(columns_).subspan(
        colour * table_->count() + table_->band_chunks()[chunk].first,
        counts_[chunk * kColours + colour]);
}

}  // namespace relume::engine
