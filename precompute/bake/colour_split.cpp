#include "precompute/bake/colour_split.h"

#include <algorithm>

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
    const float* red = row.rgb[0].data();
    const float* green = row.rgb[1].data();
    const float* blue = row.rgb[2].data();
    for (std::uint32_t k = 0; k < model.channels; ++k) {
        channels.channel[k].resize(count);
    }
    const auto [fr, fg, fb] = untinted.factor;
    const float mean = untinted.count > 0 ? 1 / untinted.count : 0;
    float* luma = channels.channel[0].data();
    if (grey || untinted.count < 3) {
        for (std::size_t j = 0; j < count; ++j) {
            luma[j] = (red[j] * fr + green[j] * fg + blue[j] * fb) * mean;
        }
    }
    if (grey) {
        return;
    }
    // luma = (R+G+B)/3, first = (R−B)/2, second = (R−2G+B)/6.
    float* first = channels.channel[1].data();
    float* second = channels.channel[2].data();
    const auto split = [&](std::size_t j, float r, float g, float b) {
        luma[j] = (r + g + b) * (1.0F / 3);
        first[j] = (r - b) * 0.5F;
        second[j] = (r - 2 * g + b) * (1.0F / 6);
    };
    if (untinted.count == 3) {
        for (std::size_t j = 0; j < count; ++j) {
            split(j, red[j] * fr, green[j] * fg, blue[j] * fb);
        }
        return;
    }
    for (std::size_t j = 0; j < count; ++j) {
        const float grey_value = luma[j];
        split(j, fr > 0 ? red[j] * fr : grey_value, fg > 0 ? green[j] * fg : grey_value,
              fb > 0 ? blue[j] * fb : grey_value);
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
