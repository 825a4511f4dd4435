// Pictures of wood by formula.
#pragma once

#include "precompute/scene/texture.h"

#include <cstdint>

namespace relume::scene {

// A board; grain runs along u and repeats.
[[nodiscard]] Texture wood_texture(std::uint32_t side);
// Parquet: squares × squares fields of light and dark wood in turn, grain turned by 90° from
// one to the next, thin dark joints between.
[[nodiscard]] Texture parquet_texture(std::uint32_t side, std::uint32_t squares);
// Floor boards along u, each with its own tone, bevelled joints.
[[nodiscard]] Texture floorboard_texture(std::uint32_t side, std::uint32_t boards);

}  // namespace relume::scene
