// Textures by formula.
#pragma once

#include "precompute/scene/texture.h"

#include <Imath/ImathVec.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace relume::scene {

// side×side texels, each of colour(u, v) at its middle, which is clamped to [0, 1].
template <typename Colour>
Texture painted(const std::string& name, std::uint32_t side, Colour colour) {
    std::vector<half> rgba;
    rgba.reserve(std::size_t{4} * side * side);
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const float u = (static_cast<float>(column) + 0.5F) / static_cast<float>(side);
            const float v = 1.0F - (static_cast<float>(row) + 0.5F) / static_cast<float>(side);
            const Imath::V3f c = colour(u, v);
            for (int channel = 0; channel < 3; ++channel)
                rgba.emplace_back(std::clamp(c[channel], 0.0F, 1.0F));
            rgba.emplace_back(1.0F);
        }
    }
    return {name, side, side, std::move(rgba)};
}

// 0 on the border of a cell, 1 from `width` (of the cell) inwards.
inline float inside(float x, float width) {
    const float t = std::clamp(std::min(x, 1.0F - x) / width, 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

}  // namespace relume::scene
