// Which sides of triangles can be seen: of those that bound something solid, the outer one.
#pragma once

#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

// Triangles whose corners are the same points wherever they touch.
struct PointTriangles {
    std::span<const Imath::V3f> points;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

enum class SeenSides : std::uint8_t {
    both,
    front,  // from which a triangle's corners run counter-clockwise
    back
};

// By triangle. Parts are triangles that are joined at edges, two by two, one running each way;
// at an edge that several pairs share, as where boxes touch, those are joined that are closest
// in the order of triangles. A part is solid where all its edges are balanced within it, and is
// seen from outside alone, whichever way its triangles face; a fin on a solid is a part of its
// own, of which both sides are seen. A shell around `eye` is a room: both its sides are seen.
[[nodiscard]] std::vector<SeenSides> seen_sides(const PointTriangles& surface,
                                                const Imath::V3f& eye);

}  // namespace relume::bake
