// The lighting cubemap: six square faces of n×n texels, n a power of two from 4 to 256.
//
// World frame: right-handed, +Y up. Faces are seen from the centre of the cube; the texel order
// and orientation are those of OpenGL. `u` grows with the column, `v` with the row, both in
// [-1, 1] over a face:
//     +X (1,-v,-u)  -X (-1,-v,u)  +Y (u,1,v)  -Y (u,-1,-v)  +Z (u,-v,1)  -Z (-u,-v,-1)
// Texel index: face·n² + row·n + column.
#pragma once

#include <Imath/ImathVec.h>

#include <cstddef>
#include <cstdint>

namespace relume::basis {

inline constexpr std::uint32_t kFaceCount = 6;
inline constexpr std::uint32_t kMinFaceResolution = 4;
inline constexpr std::uint32_t kMaxFaceResolution = 256;

enum class Face : std::uint8_t {
    positive_x,
    negative_x,
    positive_y,
    negative_y,
    positive_z,
    negative_z
};

struct Texel {
    Face face = Face::positive_x;
    std::uint32_t row = 0;
    std::uint32_t column = 0;

    friend bool operator==(const Texel&, const Texel&) = default;
};

// A point on a face; u and v in [-1, 1].
struct FacePoint {
    Face face = Face::positive_x;
    float u = 0;
    float v = 0;
};

[[nodiscard]] bool is_face_resolution(std::uint32_t n);

// Texels, and equally wavelets, of a cubemap of resolution n: 6·n².
[[nodiscard]] constexpr std::size_t texel_count(std::uint32_t n) {
    return std::size_t{kFaceCount} * n * n;
}
[[nodiscard]] constexpr std::size_t index_from_texel(std::uint32_t n, const Texel& texel) {
    return (static_cast<std::size_t>(texel.face) * n + texel.row) * n + texel.column;
}
[[nodiscard]] Texel texel_from_index(std::uint32_t n, std::size_t index);

// Not normalised: the point where the direction pierces the cube of half-width one.
[[nodiscard]] Imath::V3f cube_point_from_face_point(const FacePoint& point);
// `direction` may have any non-zero length.
[[nodiscard]] FacePoint face_point_from_direction(const Imath::V3f& direction);

// Unit direction through the texel at fractional offsets from its corner, each in [0, 1];
// (0.5, 0.5) is its centre.
[[nodiscard]] Imath::V3f direction_from_texel(std::uint32_t n,
                                              const Texel& texel,
                                              float column_offset = 0.5F,
                                              float row_offset = 0.5F);
[[nodiscard]] Texel texel_from_direction(std::uint32_t n, const Imath::V3f& direction);

// Exact solid angle of the rectangle [u0,u1]×[v0,v1] on any face, and of one texel. The
// texels of a cubemap sum to 4π.
[[nodiscard]] double solid_angle_sr(double u0, double v0, double u1, double v1);
[[nodiscard]] double solid_angle_sr(std::uint32_t n, std::uint32_t row, std::uint32_t column);

}  // namespace relume::basis
