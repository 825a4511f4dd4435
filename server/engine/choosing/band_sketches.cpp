#include "server/engine/choosing/band_sketches.h"

#include "server/engine/kernels/vector_loops.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace relume::engine {
namespace {

using transport::kColours;
using transport::Sketch;

// Adds the columns `column_at(0 … count-1)` of one colour, weighted by `amount_of(i)`.
template <typename ColumnAt, typename AmountOf, typename Float>
void add_colour(const Sketch& sketch,
                std::uint32_t colour,
                std::size_t count,
                const ColumnAt& column_at,
                const AmountOf& amount_of,
                std::span<Float> sums) {
    thread_local std::vector<WeightedRow> rows;
    rows.resize(std::max(rows.size(), count));
    std::size_t used = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t column = column_at(i);
        const float weight = amount_of(i) * sketch.scale(column, colour);
        rows[used] = {.first = sketch.first_value(column, colour), .weight = weight};
        used += weight != 0 ? 1 : 0;
    }
    add_rows(sketch.table(), std::span(rows).first(used), sums);
}

template <typename Float>
void add_changes(const Sketch& sketch,
                 std::span<const ColumnChange> changes,
                 std::span<Float> sums) {
    for (std::uint32_t c = 0; c < kColours; ++c) {
        add_colour(
            sketch, c, changes.size(), [&](std::size_t i) { return changes[i].column; },
            [&](std::size_t i) { return changes[i].amount(c); },
            sums.subspan(c * std::size_t{sketch.rows()}, sketch.rows()));
    }
}

}  // namespace

void add_sketch(const Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<float> sums) {
    add_changes(sketch, changes, sums);
}

void add_sketch(const Sketch& sketch,
                std::span<const ColumnChange> changes,
                std::span<double> sums) {
    add_changes(sketch, changes, sums);
}

BandSketches::BandSketches(const ColumnTable& table, const Sketch& sketch)
    : table_(&table),
      sketch_(&sketch),
      size_(kColours * std::size_t{sketch.rows()}),
      row_weights_(sketch.rows(), 1.0F),
      bands_(table.band_count() * size_),
      partial_(table.band_chunks().size() * size_) {}

void BandSketches::set_block_weights(std::span<const float> weights) {
    const transport::SketchStrata& strata = sketch_->strata();
    std::vector<double> sums(strata.strata);
    std::vector<double> counts(strata.strata);
    for (std::uint32_t block = 0; block < weights.size(); ++block) {
        sums[strata.stratum_of_block(block)] += double{weights[block]};
        counts[strata.stratum_of_block(block)] += 1;
    }
    for (std::uint32_t i = 0; i < strata.strata; ++i) {
        std::fill_n(&row_weights_[strata.first_row(i)], strata.row_count(i),
                    static_cast<float>(sums[i] / counts[i]));
    }
}

void BandSketches::set(const SignificantColumns& significant) {
    const std::span<const BandChunk> chunks = table_->band_chunks();
    const std::size_t rows = sketch_->rows();
    std::fill(partial_.begin(), partial_.end(), 0.0F);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t chunk) {
        for (std::uint32_t c = 0; c < kColours; ++c) {
            const std::span<const SignificantColumns::Column> columns =
                significant.of(chunk, c);
            add_colour(
                *sketch_, c, columns.size(), [&](std::size_t i) { return columns[i].column; },
                [&](std::size_t i) { return columns[i].amount; },
                std::span(partial_).subspan(chunk * size_ + c * rows, rows));
        }
    });
    std::fill(bands_.begin(), bands_.end(), 0.0);
    for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk) {
        const std::span<const float> part = std::span(partial_).subspan(chunk * size_, size_);
        double* band = &bands_[chunks[chunk].band * size_];
        for (std::size_t i = 0; i < size_; ++i) {
            band[i] += double{part[i]};
        }
    }
}

void BandSketches::apply(const Plan& plan) {
    for (std::uint32_t b = 0; b < table_->band_count(); ++b) {
        const std::span<double> sketch = std::span(bands_).subspan(b * size_, size_);
        if (plan.resets(b)) {
            std::fill(sketch.begin(), sketch.end(), 0.0);
        }
        add_sketch(*sketch_, changes_of_band(plan.changes, table_->bands(), b), sketch);
    }
}

double BandSketches::sum(std::size_t r) const {
    double total = 0;
    for (std::size_t i = r; i < bands_.size(); i += size_) {
        total += bands_[i];
    }
    return total;
}

}  // namespace relume::engine
