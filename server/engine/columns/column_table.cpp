#include "server/engine/columns/column_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace relume::engine {

using relighting::Priority;
using transport::kColours;

namespace {

void require_count(const char* what, std::size_t found, std::size_t expected) {
    if (found != expected) {
        throw std::invalid_argument(
            fmt::format("{} of columns: found {}, expected {}", what, found, expected));
    }
}

}  // namespace

ColumnTable::ColumnTable(Columns columns)
    : bands_(std::move(columns.bands)),
      bytes_(columns.bytes),
      total_bytes_(std::accumulate(bytes_.begin(), bytes_.end(), std::uint64_t{0})),
      stating_(columns.stating),
      choosing_(columns.choosing) {
    require_count("bytes", bytes_.size(), count());
    require_count("energies", columns.energies.size(), kColours * count());
    for (const transport::Sketch* sketch : {&stating_, &choosing_}) {
        require_count("sketched values", sketch->table().size(),
                      kColours * count() * sketch->rows());
    }
    if (band_count() > basis::kMaxBands) {
        throw std::invalid_argument(fmt::format("a basis has {} bands, expected at most {}",
                                                band_count(), basis::kMaxBands));
    }
    order_by_band();
    make_weights(columns.energies);
}

void ColumnTable::order_by_band() {
    constexpr std::size_t kColumnsPerChunk = 1024;
    by_band_.resize(count());
    std::iota(by_band_.begin(), by_band_.end(), 0U);
    places_ = by_band_;
    std::stable_sort(
        by_band_.begin(), by_band_.end(),
        [this](std::uint32_t a, std::uint32_t b) { return bands()[a] < bands()[b]; });
    for (std::uint32_t band = 0; band <= band_count(); ++band) {
        const auto begin =
            std::partition_point(by_band_.begin(), by_band_.end(),
                                 [&](std::uint32_t j) { return bands()[j] < band; });
        band_begins_.push_back(static_cast<std::size_t>(begin - by_band_.begin()));
    }
    for (std::size_t place = 0; place < by_band_.size(); ++place) {
        const std::uint32_t band = bands()[by_band_[place]];
        if (band_chunks_.empty() || band_chunks_.back().band != band ||
            place - band_chunks_.back().first == kColumnsPerChunk) {
            band_chunks_.push_back({.band = band, .first = place, .last = place});
        }
        band_chunks_.back().last = place + 1;
    }
}

void ColumnTable::make_weights(std::span<const float> energies) {
    for (auto& weights : weights_) {
        weights.resize(kColours * count());
    }
    const auto weight = [this](Priority priority, std::size_t place) -> float& {
        return weights_[static_cast<std::size_t>(priority)][place];
    };
    for (std::size_t j = 0; j < count(); ++j) {
        for (std::size_t c = 0; c < kColours; ++c) {
            const std::size_t place = c * count() + j;
            const float norm = std::sqrt(energies[j * kColours + c]);
            weight(Priority::none, place) = 1;
            weight(Priority::area, place) = std::exp2(-bands_.octaves[bands()[j]]);
            weight(Priority::transport, place) = norm;
            // A column without bytes is zero and gains nothing.
            weight(Priority::benefit, place) =
                bytes(j) == 0 ? 0 : norm / std::sqrt(static_cast<float>(bytes(j)));
        }
    }
}

}  // namespace relume::engine
