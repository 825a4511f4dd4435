// Polygons as OBJ and PLY know them: corners that refer to lists of positions, texture
// coordinates and normals.
#pragma once

#include <Imath/ImathVec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace relume::scene {

inline constexpr std::uint32_t kNone = 0xFFFFFFFF;

// What becomes of the normals that a file does not give.
namespace smoothing {
inline constexpr std::uint32_t kFacets = 0;  // each face is flat
// Any other number but this one: smooth among the faces that have it.
inline constexpr std::uint32_t kByAngle = 0xFFFFFFFF;  // smooth up to edges of 60°
}  // namespace smoothing

struct PolygonCorner {
    std::uint32_t position = 0;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
};

struct Polygon {
    std::uint32_t first = 0;  // corner
    std::uint32_t count = 0;  // corners, at least 3
    std::uint32_t material = 0;
    std::uint32_t smoothing = smoothing::kByAngle;
};

// Corners' indices lie within the lists.
struct PolygonMesh {
    std::string name{};
    std::vector<Imath::V3d> positions{};
    std::vector<Imath::V3f> colours{};  // per position, linear; empty: white
    std::vector<Imath::V2f> uvs{};      // v upwards
    std::vector<Imath::V3f> normals{};  // need not be unit
    std::vector<PolygonCorner> corners{};
    std::vector<Polygon> polygons{};
};

}  // namespace relume::scene
