#include "precompute/bake/blocks/colour_split.h"

#include "protocol/basis/cpu_clones.h"

#include <algorithm>
#include <span>

namespace relume::bake {
namespace {

// Colour of mean 1; white where there is nothing.
Imath::V3f tint_from(const Imath::V3f& white) {
    const float mean = (white.x + white.y + white.z) / 3;
    if (mean <= 0) {
        return {1, 1, 1};
    }
    return {std::max(white.x, 0.0F) / mean, std::max(white.y, 0.0F) / mean,
            std::max(white.z, 0.0F) / mean};
}

// Each colour's row over its tint. A colour the tint has none of takes no part.
struct Untinted {
    std::array<float, 3> factor{};
    float count = 0;

    explicit Untinted(const Imath::V3f& tint) {
        constexpr float kLeastTint = 1e-4F;
        for (int c = 0; c < 3; ++c) {
            const bool present = tint[c] > kLeastTint;
            factor[static_cast<std::size_t>(c)] = present ? 1 / tint[c] : 0.0F;
            count += present ? 1 : 0;
        }
    }
};

using Colours = std::array<std::span<const float>, 3>;
using Channels = std::array<std::span<float>, 3>;

RELUME_CPU_CLONES void weighted_mean(const Colours& rgb,
                                     const Untinted& untinted,
                                     std::span<float> mean) {
    const float inverse = untinted.count > 0 ? 1 / untinted.count : 0;
    const auto [r, g, b] = untinted.factor;
    for (std::size_t j = 0; j < mean.size(); ++j) {
        mean[j] = (rgb[0][j] * r + rgb[1][j] * g + rgb[2][j] * b) * inverse;
    }
}

// (R+G+B)/3, (R−B)/2, (R−2G+B)/6.
RELUME_CPU_CLONES void luma_and_chroma(const Colours& rgb,
                                       const Untinted& untinted,
                                       const Channels& out) {
    const auto [fr, fg, fb] = untinted.factor;
    const std::size_t count = out[0].size();
    const float* red = rgb[0].data();
    const float* green = rgb[1].data();
    const float* blue = rgb[2].data();
    float* luma = out[0].data();
    float* first = out[1].data();
    float* second = out[2].data();
    for (std::size_t j = 0; j < count; ++j) {
        const float r = red[j] * fr;
        const float g = green[j] * fg;
        const float b = blue[j] * fb;
        luma[j] = (r + g + b) * (1.0F / 3);
        first[j] = (r - b) * 0.5F;
        second[j] = (r - 2 * g + b) * (1.0F / 6);
    }
}

}  // namespace

transport::ColourModel grey_model() {
    return {.channels = 1, .matrix = {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}}};
}

transport::ColourModel luma_chroma_model() {
    return {.channels = 3, .matrix = {{{1, 1, 1}, {1, 0, -2}, {1, -1, 1}}}};
}

void split_colours(const transport::ColourModel& model,
                   const CoefficientRow& row,
                   ChannelRow& channels) {
    const std::size_t count = row.rgb[0].size();
    const bool grey = model.channels == 1;
    const Imath::V3f& direct = row.direct_white;
    channels.tint = tint_from(grey || direct.x + direct.y + direct.z <= 0 ? row.white : direct);
    const Untinted untinted(channels.tint);
    for (std::uint32_t k = 0; k < model.channels; ++k) {
        channels.channel[k].resize(count);
    }
    const Colours colours{row.rgb[0], row.rgb[1], row.rgb[2]};
    if (grey || untinted.count < 3) {
        weighted_mean(colours, untinted, channels.channel[0]);
    }
    if (grey) {
        return;
    }
    const Channels out{channels.channel[0], channels.channel[1], channels.channel[2]};
    if (untinted.count == 3) {
        luma_and_chroma(colours, untinted, out);
        return;
    }
    for (std::size_t j = 0; j < count; ++j) {
        std::array<float, 3> value{};
        for (std::size_t c = 0; c < 3; ++c) {
            const float factor = untinted.factor[c];
            value[c] = factor > 0 ? row.rgb[c][j] * factor : channels.channel[0][j];
        }
        out[0][j] = (value[0] + value[1] + value[2]) * (1.0F / 3);
        out[1][j] = (value[0] - value[2]) * 0.5F;
        out[2][j] = (value[0] - 2 * value[1] + value[2]) * (1.0F / 6);
    }
}

ChromaResidual chroma_residual(const CoefficientRow& row) {
    ChannelRow grey;
    split_colours(grey_model(), row, grey);
    ChromaResidual sums;
    for (std::size_t c = 0; c < 3; ++c) {
        const float tint = grey.tint[static_cast<int>(c)];
        for (std::size_t j = 0; j < row.rgb[c].size(); ++j) {
            const double value = row.rgb[c][j];
            const double lost = value - double{tint} * grey.channel[0][j];
            sums.residual += lost * lost;
            sums.energy += value * value;
        }
    }
    return sums;
}

}  // namespace relume::bake
