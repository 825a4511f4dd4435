// Pictures of stone by formula. They repeat in both directions.
#pragma once

#include "precompute/scene/texture.h"

#include <cstdint>

namespace relume::scene {

// Square flagstones, stones × stones, each with its own tone, dark joints between.
[[nodiscard]] Texture flagstone_texture(std::uint32_t side, std::uint32_t stones);
// Dark with light grains.
[[nodiscard]] Texture asphalt_texture(std::uint32_t side);
// Bricks along u, `across` of them in a course, courses of two thirds of a brick in pairs.
[[nodiscard]] Texture brick_texture(std::uint32_t side,
                                    std::uint32_t across,
                                    std::uint32_t courses);

}  // namespace relume::scene
