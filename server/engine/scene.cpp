#include "server/engine/scene.h"

#include "server/engine/spare_images.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace relume::engine {

using transport::kColours;

Scene::Scene(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)),
      projection_(basis::CubemapProjection::onto(light_basis())),
      spare_images_(std::make_unique<SpareImages>()) {
    const std::size_t count = transport_->column_count();
    bands_.resize(count);
    for (auto& weights : weights_) {
        weights.resize(kColours * count);
    }
    for (std::size_t j = 0; j < count; ++j) {
        const std::uint32_t band = light_basis().band_from_coefficient(j);
        bands_[j] = static_cast<std::uint8_t>(band);
        const std::uint32_t bytes = transport_->column_bytes(j);
        for (std::uint32_t c = 0; c < kColours; ++c) {
            const std::size_t place = c * count + j;
            weights_[static_cast<std::size_t>(relighting::Priority::none)][place] = 1;
            weights_[static_cast<std::size_t>(relighting::Priority::area)][place] =
                std::exp2(-light_basis().octave_from_band(band));
            const float norm = std::sqrt(transport_->energy(j, c));
            weights_[static_cast<std::size_t>(relighting::Priority::transport)][place] = norm;
            // A column without bytes is zero and gains nothing.
            weights_[static_cast<std::size_t>(relighting::Priority::benefit)][place] =
                bytes == 0 ? 0 : norm / std::sqrt(static_cast<float>(bytes));
        }
    }
    order_by_band();
    strips_ = std::make_unique<const StripMatrix>(*transport_, columns_by_band_, band_chunks_);
}

Scene::~Scene() = default;

void Scene::order_by_band() {
    constexpr std::size_t kColumnsPerChunk = 1024;
    columns_by_band_.resize(coefficient_count());
    std::iota(columns_by_band_.begin(), columns_by_band_.end(), 0U);
    places_ = columns_by_band_;
    std::stable_sort(
        columns_by_band_.begin(), columns_by_band_.end(),
        [this](std::uint32_t a, std::uint32_t b) { return bands_[a] < bands_[b]; });
    for (std::uint32_t band = 0; band <= band_count(); ++band) {
        const auto begin =
            std::partition_point(columns_by_band_.begin(), columns_by_band_.end(),
                                 [&](std::uint32_t j) { return bands_[j] < band; });
        band_begins_.push_back(static_cast<std::size_t>(begin - columns_by_band_.begin()));
    }
    for (std::size_t place = 0; place < columns_by_band_.size(); ++place) {
        const std::uint32_t band = bands_[columns_by_band_[place]];
        if (band_chunks_.empty() || band_chunks_.back().band != band ||
            place - band_chunks_.back().first == kColumnsPerChunk) {
            band_chunks_.push_back({.band = band, .first = place, .last = place});
        }
        band_chunks_.back().last = place + 1;
    }
}

std::size_t Scene::sum_count() const {
    return std::size_t{block_count()} * kColours * transport::kBlockSize;
}

}  // namespace relume::engine
