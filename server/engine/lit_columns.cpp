#include "server/engine/lit_columns.h"

#include "server/engine/kernels/vector_loops.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace relume::engine {

using transport::kColours;

LitColumns::LitColumns(const Scene& scene)
    : scene_(&scene),
      norms_(kColours * scene.coefficient_count()),
      columns_(norms_.size()),
      counts_(kColours * scene.band_chunks().size()) {}

void LitColumns::set(std::span<const float> lighting) {
    norms_.assign(lighting.begin(), lighting.end());
    take(lighting, 0);
}

void LitColumns::set_nearly(std::span<const float> lighting, double negligible) {
    const std::span<const float> weights = scene_->weights(relighting::Priority::transport);
    for (std::size_t i = 0; i < norms_.size(); ++i) {
        norms_[i] = lighting[i] * weights[i];
    }
    const double of_each =
        negligible * std::sqrt(squared_norm(norms_) / static_cast<double>(norms_.size()));
    // Lighting of 10¹⁹ cannot be squared; all of it counts then.
    take(lighting, std::isfinite(of_each) ? static_cast<float>(of_each) : 0);
}

void LitColumns::take(std::span<const float> lighting, float negligible) {
    const std::size_t count = scene_->coefficient_count();
    const std::span<const BandChunk> chunks = scene_->band_chunks();
    tbb::parallel_for(std::size_t{0}, kColours * chunks.size(), [&](std::size_t i) {
        const BandChunk& chunk = chunks[i / kColours];
        const std::size_t first = i % kColours * count;
        Column* const columns = &columns_[first + chunk.first];
        std::size_t taken = 0;
        for (std::size_t place = chunk.first; place < chunk.last; ++place) {
            const std::uint32_t column = scene_->columns_by_band()[place];
            columns[taken] = {.column = column, .amount = lighting[first + column]};
            taken += std::abs(norms_[first + column]) > negligible ? 1U : 0U;
        }
        counts_[i] = taken;
    });
}

std::span<const LitColumns::Column> LitColumns::of(std::size_t chunk,
                                                   std::uint32_t colour) const {
    return std::span(columns_).subspan(
        colour * scene_->coefficient_count() + scene_->band_chunks()[chunk].first,
        counts_[chunk * kColours + colour]);
}

}  // namespace relume::engine
