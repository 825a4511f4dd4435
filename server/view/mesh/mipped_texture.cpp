#include "server/view/mesh/mipped_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::view {
namespace {

using transport::TextureWrap;

// Which texels of a row of `from` one of `to` texels is the mean of, and how much each counts.
struct Share {
    std::uint32_t texel;
    float weight;
};
std::vector<Share> shares_of(std::uint32_t texel, std::uint32_t from, std::uint32_t to) {
    const double width = static_cast<double>(from) / to;
    const double begin = texel * width;
    std::vector<Share> shares;
    for (auto i = static_cast<std::uint32_t>(begin); i < from; ++i) {
        const double overlap =
            std::min(begin + width, i + 1.0) - std::max(begin, static_cast<double>(i));
        if (overlap <= 1e-9) {
            break;
        }
        shares.push_back({.texel = i, .weight = static_cast<float>(overlap / width)});
    }
    return shares;
}

std::vector<half> shrunk(std::span<const half> rgb,
                         std::uint32_t width,
                         std::uint32_t height,
                         std::uint32_t to_width,
                         std::uint32_t to_height) {
    std::vector<half> smaller(std::size_t{3} * to_width * to_height);
    std::vector<std::vector<Share>> columns;
    for (std::uint32_t x = 0; x < to_width; ++x) {
        columns.push_back(shares_of(x, width, to_width));
    }
    for (std::uint32_t y = 0; y < to_height; ++y) {
        const std::vector<Share> rows = shares_of(y, height, to_height);
        for (std::uint32_t x = 0; x < to_width; ++x) {
            std::array<float, 3> sum{};
            for (const Share& row : rows) {
                for (const Share& column : columns[x]) {
                    const std::size_t at = 3 * (std::size_t{row.texel} * width + column.texel);
                    for (std::size_t c = 0; c < 3; ++c) {
                        sum[c] += row.weight * column.weight * float{rgb[at + c]};
                    }
                }
            }
            for (std::size_t c = 0; c < 3; ++c) {
                smaller[3 * (std::size_t{y} * to_width + x) + c] = half(sum[c]);
            }
        }
    }
    return smaller;
}

// `at` may be any whole number that a float holds.
std::uint32_t wrapped(float at, std::uint32_t size, TextureWrap wrap) {
    const auto texels = static_cast<float>(size);
    if (wrap == TextureWrap::clamp) {
        return static_cast<std::uint32_t>(std::clamp(at, 0.0F, texels - 1));
    }
    const float period = wrap == TextureWrap::mirror ? 2 * texels : texels;
    const float within = std::clamp(at - std::floor(at / period) * period, 0.0F, period - 1);
    const auto texel = static_cast<std::uint32_t>(within);
    return texel < size ? texel : 2 * size - 1 - texel;
}

// Beyond this many texels a float knows no places between them.
float bounded(float texels) {
    constexpr float kMost = 4194304;
    return texels > -kMost && texels < kMost ? texels : 0;
}

}  // namespace

MippedTexture::MippedTexture(const transport::SurfaceTexture& texture) : texture_(texture) {
    levels_.push_back({texture.width, texture.height, texture.rgb});
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& last = levels_.back();
        const std::uint32_t width = std::max(last.width / 2, 1U);
        const std::uint32_t height = std::max(last.height / 2, 1U);
        smaller_.push_back(shrunk(last.rgb, last.width, last.height, width, height));
        levels_.push_back({width, height, smaller_.back()});
    }
}

std::size_t MippedTexture::bytes() const {
    std::size_t bytes = 0;
    for (const std::vector<half>& level : smaller_) {
        bytes += level.size() * sizeof(half);
    }
    return bytes;
}

Imath::V3f MippedTexture::bilinear(std::size_t level, const Imath::V2f& uv) const {
    const Level& texels = levels_[level];
    const float x = bounded(uv.x * static_cast<float>(texels.width) - 0.5F);
    const float y = bounded((1 - uv.y) * static_cast<float>(texels.height) - 0.5F);
    const float left = std::floor(x);
    const float top = std::floor(y);
    const auto texel = [&](float at_x, float at_y) {
        const std::uint32_t column = wrapped(at_x, texels.width, texture_.wrap_u);
        const std::uint32_t row = wrapped(at_y, texels.height, texture_.wrap_v);
        const half* const rgb = &texels.rgb[3 * (std::size_t{row} * texels.width + column)];
        return Imath::V3f(rgb[0], rgb[1], rgb[2]);
    };
    const float right_share = x - left;
    const float lower_share = y - top;
    return (texel(left, top) * (1 - right_share) + texel(left + 1, top) * right_share) *
               (1 - lower_share) +
           (texel(left, top + 1) * (1 - right_share) + texel(left + 1, top + 1) * right_share) *
               lower_share;
}

Imath::V3f MippedTexture::trilinear(float level, const Imath::V2f& uv) const {
    const auto coarsest = static_cast<float>(levels_.size() - 1);
    const float bound = std::clamp(level, 0.0F, coarsest);
    const auto finer = static_cast<std::size_t>(bound);
    const float share = bound - static_cast<float>(finer);
    const Imath::V3f fine = bilinear(finer, uv);
    return share > 0 ? fine * (1 - share) + bilinear(finer + 1, uv) * share : fine;
}

Imath::V3f MippedTexture::mean(const Imath::V2f& uv,
                               const Imath::V2f& across,
                               const Imath::V2f& along) const {
    constexpr float kMostProbes = 8;
    const auto texels_of = [this](const Imath::V2f& side) {
        const float length = std::hypot(side.x * static_cast<float>(texture_.width),
                                        side.y * static_cast<float>(texture_.height));
        return length < 1e9F ? std::max(length, 1e-6F) : 1e9F;  // also of what is no number
    };
    const float texels_across = texels_of(across);
    const float texels_along = texels_of(along);
    const bool is_longer_across = texels_across > texels_along;
    const float longer = is_longer_across ? texels_across : texels_along;
    const float shorter = std::max(is_longer_across ? texels_along : texels_across, 1.0F);
    const float probes = std::clamp(std::ceil(longer / shorter), 1.0F, kMostProbes);
    const float level = std::log2(std::max(longer / probes, shorter));
    if (probes == 1) {
        return trilinear(level, uv);
    }
    const Imath::V2f& side = is_longer_across ? across : along;
    Imath::V3f sum(0);
    for (float i = 0.5F; i < probes; ++i) {
        sum += trilinear(level, uv + side * (i / probes - 0.5F));
    }
    return sum / probes;
}

}  // namespace relume::view
