#include "server/view/mesh/mipped_texture.h"

#include <algorithm>
#include <array>
#include <bit>
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

// Calls at(column, row) for the first level's texel, and the like for others.
template <typename At>
void shrink(const At& at,
            std::uint32_t width,
            std::uint32_t height,
            std::uint32_t to_width,
            std::uint32_t to_height,
            std::array<float, 4>* smaller) {
    std::vector<std::vector<Share>> columns;
    for (std::uint32_t x = 0; x < to_width; ++x) {
        columns.push_back(shares_of(x, width, to_width));
    }
    for (std::uint32_t y = 0; y < to_height; ++y) {
        const std::vector<Share> rows = shares_of(y, height, to_height);
        for (std::uint32_t x = 0; x < to_width; ++x) {
            std::array<float, 4>& sum = smaller[std::size_t{y} * to_width + x];
            for (const Share& row : rows) {
                for (const Share& column : columns[x]) {
                    const Imath::V3f texel = at(column.texel, row.texel);
                    for (int c = 0; c < 3; ++c) {
                        sum[static_cast<std::size_t>(c)] +=
                            row.weight * column.weight * texel[c];
                    }
                }
            }
        }
    }
}

std::uint32_t wrapped(std::int32_t at, std::uint32_t size, TextureWrap wrap) {
    if (static_cast<std::uint32_t>(at) < size) {
        return static_cast<std::uint32_t>(at);
    }
    const auto texels = static_cast<std::int32_t>(size);
    if (wrap == TextureWrap::clamp) {
        return at < 0 ? 0 : size - 1;
    }
    if (wrap == TextureWrap::repeat && std::has_single_bit(size)) {
        return static_cast<std::uint32_t>(at) & (size - 1);
    }
    const std::int32_t period = wrap == TextureWrap::mirror ? 2 * texels : texels;
    const std::int32_t remainder = at % period;
    const std::int32_t within = remainder < 0 ? remainder + period : remainder;
    return static_cast<std::uint32_t>(within < texels ? within : period - 1 - within);
}

// The whole number at or below; quicker than the library's, which takes all numbers.
std::int32_t floor_of(float texels) {
    const auto towards_zero = static_cast<std::int32_t>(texels);
    return towards_zero - (static_cast<float>(towards_zero) > texels ? 1 : 0);
}

// Beyond this many texels a float knows no places between them.
float bounded(float texels) {
    constexpr float kMost = 4194304;
    return texels > -kMost && texels < kMost ? texels : 0;
}

}  // namespace

MippedTexture::MippedTexture(const transport::SurfaceTexture& texture) : texture_(texture) {
    static_assert(sizeof(Texel) == sizeof(std::array<float, 4>));
    levels_.push_back({texture.width, texture.height, {}});
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& last = levels_.back();
        Level next{.width = std::max(last.width / 2, 1U),
                   .height = std::max(last.height / 2, 1U),
                   .texels = {}};
        next.texels.resize(std::size_t{next.width} * next.height);
        const auto at = [&](std::uint32_t column, std::uint32_t row) {
            const std::size_t place = std::size_t{row} * last.width + column;
            if (last.texels.empty()) {
                const half* const rgb = &texture.rgb[3 * place];
                return Imath::V3f(rgb[0], rgb[1], rgb[2]);
            }
            const auto& rgb = last.texels[place].rgb;
            return Imath::V3f(rgb[0], rgb[1], rgb[2]);
        };
        shrink(at, last.width, last.height, next.width, next.height, &next.texels[0].rgb);
        levels_.push_back(std::move(next));
    }
}

std::size_t MippedTexture::bytes() const {
    std::size_t bytes = 0;
    for (const Level& level : levels_) {
        bytes += level.texels.size() * sizeof(Texel);
    }
    return bytes;
}

MippedTexture::Corner MippedTexture::corner_at(const Level& level, const Imath::V2f& uv) const {
    const float x = bounded(uv.x * static_cast<float>(level.width) - 0.5F);
    const float y = bounded((1 - uv.y) * static_cast<float>(level.height) - 0.5F);
    const std::int32_t left = floor_of(x);
    const std::int32_t top = floor_of(y);
    return {.columns = {wrapped(left, level.width, texture_.wrap_u),
                        wrapped(left + 1, level.width, texture_.wrap_u)},
            .rows = {wrapped(top, level.height, texture_.wrap_v),
                     wrapped(top + 1, level.height, texture_.wrap_v)},
            .right_share = x - static_cast<float>(left),
            .lower_share = y - static_cast<float>(top)};
}

void MippedTexture::add_bilinear(std::size_t level,
                                 const Imath::V2f& uv,
                                 float weight,
                                 Texel& sum) const {
    const Level& of = levels_[level];
    const Corner corner = corner_at(of, uv);
    const std::array<float, 2> across{1 - corner.right_share, corner.right_share};
    const std::array<float, 2> along{1 - corner.lower_share, corner.lower_share};
    for (std::size_t row = 0; row < 2; ++row) {
        for (std::size_t column = 0; column < 2; ++column) {
            const float part = weight * along[row] * across[column];
            const std::size_t place =
                std::size_t{corner.rows[row]} * of.width + corner.columns[column];
            if (of.texels.empty()) {
                const half* const rgb = &texture_.rgb[3 * place];
                for (std::size_t c = 0; c < 3; ++c) {
                    sum.rgb[c] += part * float{rgb[c]};
                }
                continue;
            }
            for (std::size_t c = 0; c < 4; ++c) {
                sum.rgb[c] += part * of.texels[place].rgb[c];
            }
        }
    }
}

void MippedTexture::add_trilinear(float level,
                                  const Imath::V2f& uv,
                                  float weight,
                                  Texel& sum) const {
    const auto coarsest = static_cast<float>(levels_.size() - 1);
    const float bound = std::clamp(level, 0.0F, coarsest);
    const auto finer = static_cast<std::size_t>(bound);
    const float share = bound - static_cast<float>(finer);
    add_bilinear(finer, uv, weight * (1 - share), sum);
    if (share > 0) {
        add_bilinear(finer + 1, uv, weight * share, sum);
    }
}

Imath::V3f MippedTexture::mean(const Imath::V2f& uv,
                               const Imath::V2f& across,
                               const Imath::V2f& along) const {
    constexpr float kMostProbes = 4;
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
    const Imath::V2f& side = is_longer_across ? across : along;
    Texel sum;
    for (float i = 0.5F; i < probes; ++i) {
        add_trilinear(level, uv + side * (i / probes - 0.5F), 1 / probes, sum);
    }
    return {sum.rgb[0], sum.rgb[1], sum.rgb[2]};
}

}  // namespace relume::view
