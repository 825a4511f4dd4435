#include "server/engine/scene.h"

#include "protocol/basis/haar.h"

#include <cmath>

namespace relume::engine {

using transport::kColours;

Scene::Scene(std::shared_ptr<const transport::Transport> transport)
    : transport_(std::move(transport)),
      band_count_(basis::band_count(transport_->manifest().face_resolution)) {
    const std::size_t count = transport_->column_count();
    bands_.resize(count);
    for (auto& weights : weights_) {
        weights.resize(kColours * count);
    }
    for (std::size_t j = 0; j < count; ++j) {
        const std::uint32_t band = basis::band_from_coefficient(face_resolution(), j);
        bands_[j] = static_cast<std::uint8_t>(band);
        for (std::uint32_t c = 0; c < kColours; ++c) {
            const std::size_t place = c * count + j;
            weights_[static_cast<std::size_t>(wire::Priority::none)][place] = 1;
            weights_[static_cast<std::size_t>(wire::Priority::area)][place] =
                std::ldexp(1.0F, -static_cast<int>(band));
            weights_[static_cast<std::size_t>(wire::Priority::transport)][place] =
                std::sqrt(transport_->energy(j, c));
        }
    }
}

std::size_t Scene::sum_count() const {
    return std::size_t{block_count()} * kColours * transport::kBlockSize;
}

}  // namespace relume::engine
