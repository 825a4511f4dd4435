// The points of editable materials that a pixel sees: what stands for its surfaces.
#pragma once

#include "precompute/bake/fields/point_visibility.h"
#include "precompute/bake/receivers/receiver.h"
#include "protocol/transport/seen_points.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace relume::bake {

// Of a surface that fills its pixel; of less, the fewer the less it fills.
inline constexpr std::uint32_t kMostTurnPoints = 4;   // where it turns within the pixel
inline constexpr std::uint32_t kMostAlikePoints = 2;  // where it does not
// So that a tile's points stay few whatever leaves a pixel sees. At least as many as there are
// editable materials, so that each keeps its share.
inline constexpr std::size_t kMostPointsOfPixel = 16;

struct PixelPoint {
    transport::SeenPoint seen;  // but for its slot
    LookingPoint looking;
};

// Which of the editable materials each of the scene's materials is; none: not editable.
using EditableIndices = std::vector<std::optional<std::uint8_t>>;

// Points of one material have shares that sum to those of its surfaces in the receiver. A
// surface that does not turn within the pixel is up to two points alike, whose rays leave from
// all sixteen places, and differ at shadow edges alone; one that turns is up to four of its
// turns, which have a normal each. Depends on nothing but the arguments.
[[nodiscard]] std::vector<PixelPoint> points_of_pixel(const Receiver& receiver,
                                                      const EditableIndices& editable,
                                                      std::uint64_t seed);

}  // namespace relume::bake
