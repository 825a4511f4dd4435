#include "server/engine/ranking.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

namespace relume::engine {

using transport::kColours;

void Ranking::rank(const Scene& scene,
                   const Lighting& lighting,
                   std::span<const float> weights) {
    const std::span<const BandChunk> chunks = scene.band_chunks();
    as_shown_.resize(scene.coefficient_count());
    from_nothing_.resize(scene.coefficient_count());
    distances_.resize(chunks.size());
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
        distances_[i] = rank_chunk(scene, lighting, weights, chunks[i]);
    });
    std::array<Distances, kMaxBands> bands{};
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        bands[chunks[i].band].from_nothing += distances_[i].from_nothing;
        bands[chunks[i].band].as_shown += distances_[i].as_shown;
    }
    bands_nearer_from_nothing_ = 0;
    for (std::uint32_t band = 0; band < scene.band_count(); ++band) {
        if (bands[band].from_nothing < bands[band].as_shown) {
            bands_nearer_from_nothing_ |= 1U << band;
        }
    }
}

Ranking::Distances Ranking::rank_chunk(const Scene& scene,
                                       const Lighting& lighting,
                                       std::span<const float> weights,
                                       const BandChunk& chunk) {
    const std::size_t count = scene.coefficient_count();
    const std::span<const float> target = lighting.target();
    const std::span<const float> approximation = lighting.approximation();
    // Not finite where lighting of 10¹⁹ is squared; kept finite so that all can be compared.
    const auto finite = [](float importance) {
        constexpr float kLargest = std::numeric_limits<float>::max();
        return importance <= kLargest ? importance : kLargest;
    };
    Distances distances;
    for (std::size_t place = chunk.first; place < chunk.last; ++place) {
        const std::size_t column = scene.columns_by_band()[place];
        float shown = 0;
        float nothing = 0;
        bool lit = false;
        bool differs = false;
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t i = c * count + column;
            const float wanted = target[i];
            const float difference = wanted - approximation[i];
            lit = lit || wanted != 0;
            differs = differs || wanted != approximation[i];
            nothing += weights[i] * wanted * (weights[i] * wanted);
            shown += weights[i] * difference * (weights[i] * difference);
            distances.from_nothing += double{std::abs(wanted)};
            distances.as_shown += double{std::abs(difference)};
        }
        from_nothing_[place] = lit ? finite(nothing) : kNoDifference;
        as_shown_[place] = differs ? finite(shown) : kNoDifference;
    }
    return distances;
}

}  // namespace relume::engine
