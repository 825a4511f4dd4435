#include "precompute/scene/obj/relief.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace relume::scene::obj {
namespace {

float luminance(const Imath::V4f& texel) {
    return 0.2126F * texel.x + 0.7152F * texel.y + 0.0722F * texel.z;
}

}  // namespace

Channel value_channel(const MtlTexture& how) {
    switch (how.channel) {
        case 'r':
            return [](const Imath::V4f& texel) { return texel.x; };
        case 'g':
            return [](const Imath::V4f& texel) { return texel.y; };
        case 'b':
            return [](const Imath::V4f& texel) { return texel.z; };
        case 'm':
            return [](const Imath::V4f& texel) { return texel.w; };
        default:
            return luminance;
    }
}

Channel mask_channel(const Texture& picture, const MtlTexture& how) {
    const std::span<const half> texels = picture.texels();
    for (std::size_t i = 3; i < texels.size(); i += 4) {
        if (texels[i] < 1)
            return [](const Imath::V4f& texel) { return texel.w; };
    }
    return value_channel(how);
}

bool is_normal_map(const Texture& picture) {
    Imath::V3d sum(0, 0, 0);
    const std::span<const half> texels = picture.texels();
    for (std::size_t i = 0; i < texels.size(); i += 4)
        sum += Imath::V3d(texels[i], texels[i + 1], texels[i + 2]);
    const Imath::V3d mean = sum / static_cast<double>(texels.size() / 4);
    return mean.z > 0.7 && std::abs(mean.x - 0.5) < 0.15 && std::abs(mean.y - 0.5) < 0.15;
}

Texture normals_from_height(const Texture& heights, const Channel& channel, float strength) {
    const auto width = static_cast<std::int64_t>(heights.width());
    const auto height = static_cast<std::int64_t>(heights.height());
    const auto at = [&](std::int64_t column, std::int64_t row) {
        const std::size_t first = 4 * static_cast<std::size_t>((row + height) % height * width +
                                                               (column + width) % width);
        const std::span<const half> texels = heights.texels();
        return channel(
            {texels[first], texels[first + 1], texels[first + 2], texels[first + 3]});
    };
    std::vector<half> rgba;
    rgba.reserve(heights.texels().size());
    for (std::int64_t row = 0; row < height; ++row) {
        for (std::int64_t column = 0; column < width; ++column) {
            // Rows run downwards, the texture's v upwards.
            const float along_u = (at(column + 1, row) - at(column - 1, row)) / 2;
            const float along_v = (at(column, row - 1) - at(column, row + 1)) / 2;
            const Imath::V3f normal =
                Imath::V3f(-strength * along_u, -strength * along_v, 1).normalized();
            for (int c = 0; c < 3; ++c)
                rgba.emplace_back(normal[c] * 0.5F + 0.5F);
            rgba.emplace_back(1.0F);
        }
    }
    return {heights.name(), heights.width(), heights.height(), std::move(rgba)};
}

}  // namespace relume::scene::obj
