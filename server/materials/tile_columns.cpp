#include "server/materials/tile_columns.h"

#include "protocol/basis/cpu_clones.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace relume::materials {
namespace {

constexpr float kLargest = 32767;

RELUME_CPU_CLONES void add_column(const std::int16_t* column,
                                  float weight,
                                  std::size_t pixels,
                                  float* sums) {
    for (std::size_t i = 0; i < pixels; ++i) {
        sums[i] += weight * static_cast<float>(column[i]);
    }
}

}  // namespace

TileColumns::TileColumns(std::vector<std::uint8_t> slots, ColumnValues values)
    : slots_(std::move(slots)),
      quantised_(values.samples.size()),
      diffuse_(std::move(values.diffuse)),
      baked_(std::move(values.baked)) {
    const std::size_t pixels = slots_.size();
    for (std::size_t channel = 0; channel < 3; ++channel) {
        for (std::size_t sample = 0; sample < curve::kCurveSamples; ++sample) {
            const float* const column = values.column(channel, sample);
            const float most = std::accumulate(column, column + pixels, 0.0F,
                                               [](float a, float b) { return std::max(a, b); });
            if (most == 0) {
                continue;
            }
            const float step = most / kLargest;
            steps_[channel][sample] = step;
            std::int16_t* const out =
                &quantised_[(channel * curve::kCurveSamples + sample) * pixels];
            for (std::size_t i = 0; i < pixels; ++i) {
                out[i] = static_cast<std::int16_t>(std::lround(column[i] / step));
            }
        }
    }
}

void TileColumns::change(const curve::Curve& curve,
                         const Imath::V3f& diffuse,
                         std::span<float> rgb) const {
    const std::size_t pixels = slots_.size();
    std::array<float, 256> sums;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float more = diffuse[static_cast<int>(channel)] - 1;
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::size_t at = channel * pixels + i;
            sums[i] = more * diffuse_[at] - baked_[at];
        }
        for (std::size_t sample = 0; sample < curve::kCurveSamples; ++sample) {
            const float weight = steps_[channel][sample] * curve.rgb[channel][sample];
            if (weight != 0) {
                add_column(&quantised_[(channel * curve::kCurveSamples + sample) * pixels],
                           weight, pixels, sums.data());
            }
        }
        for (std::size_t i = 0; i < pixels; ++i) {
            rgb[3 * i + channel] = sums[i];
        }
    }
}

std::size_t TileColumns::bytes() const {
    return quantised_.size() * sizeof(quantised_[0]) + sizeof(steps_) +
           (diffuse_.size() + baked_.size()) * sizeof(float) + slots_.size();
}

}  // namespace relume::materials
