// Many directions at once: planes of equal length, one float of each a direction.
#pragma once

#include <cstddef>
#include <span>

namespace relume::brdf {

struct Directions {
    std::span<const float> x, y, z;

    [[nodiscard]] std::size_t size() const { return x.size(); }
};

struct DirectionPlanes {
    std::span<float> x, y, z;
};

}  // namespace relume::brdf
