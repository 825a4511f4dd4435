#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace relume::basis {
namespace {

// Solid angle of the rectangle from the face centre to (u, v), seen from the cube's centre.
double corner_solid_angle_sr(double u, double v) {
    return std::atan2(u * v, std::sqrt(u * u + v * v + 1.0));
}

std::uint32_t texel_from_coordinate(std::uint32_t n, float coordinate) {
    const float scaled = (coordinate + 1.0F) * 0.5F * static_cast<float>(n);
    const auto last = static_cast<float>(n - 1);
    return static_cast<std::uint32_t>(std::clamp(scaled, 0.0F, last));
}

}  // namespace

bool is_face_resolution(std::uint32_t n) {
    return std::has_single_bit(n) && n >= kMinFaceResolution && n <= kMaxFaceResolution;
}

Texel texel_from_index(std::uint32_t n, std::size_t index) {
    const std::size_t face_size = std::size_t{n} * n;
    const std::size_t in_face = index % face_size;
    return {.face = static_cast<Face>(index / face_size),
            .row = static_cast<std::uint32_t>(in_face / n),
            .column = static_cast<std::uint32_t>(in_face % n)};
}

Imath::V3f cube_point_from_face_point(const FacePoint& point) {
    const float u = point.u;
    const float v = point.v;
    switch (point.face) {
        case Face::positive_x:
            return {1, -v, -u};
        case Face::negative_x:
            return {-1, -v, u};
        case Face::positive_y:
            return {u, 1, v};
        case Face::negative_y:
            return {u, -1, -v};
        case Face::positive_z:
            return {u, -v, 1};
        case Face::negative_z:
            return {-u, -v, -1};
    }
    return {0, 0, 0};
}

FacePoint face_point_from_direction(const Imath::V3f& d) {
    const float ax = std::abs(d.x);
    const float ay = std::abs(d.y);
    const float az = std::abs(d.z);
    if (ax >= ay && ax >= az) {
        return d.x >= 0 ? FacePoint{Face::positive_x, -d.z / ax, -d.y / ax}
                        : FacePoint{Face::negative_x, d.z / ax, -d.y / ax};
    }
    if (ay >= az) {
        return d.y >= 0 ? FacePoint{Face::positive_y, d.x / ay, d.z / ay}
                        : FacePoint{Face::negative_y, d.x / ay, -d.z / ay};
    }
    return d.z >= 0 ? FacePoint{Face::positive_z, d.x / az, -d.y / az}
                    : FacePoint{Face::negative_z, -d.x / az, -d.y / az};
}

Imath::V3f direction_from_texel(std::uint32_t n,
                                const Texel& texel,
                                float column_offset,
                                float row_offset) {
    const float scale = 2.0F / static_cast<float>(n);
    const FacePoint point{
        .face = texel.face,
        .u = (static_cast<float>(texel.column) + column_offset) * scale - 1.0F,
        .v = (static_cast<float>(texel.row) + row_offset) * scale - 1.0F,
    };
    return cube_point_from_face_point(point).normalized();
}

Texel texel_from_direction(std::uint32_t n, const Imath::V3f& direction) {
    const FacePoint point = face_point_from_direction(direction);
    return {.face = point.face,
            .row = texel_from_coordinate(n, point.v),
            .column = texel_from_coordinate(n, point.u)};
}

double solid_angle_sr(double u0, double v0, double u1, double v1) {
    return corner_solid_angle_sr(u0, v0) - corner_solid_angle_sr(u0, v1) -
           corner_solid_angle_sr(u1, v0) + corner_solid_angle_sr(u1, v1);
}

double solid_angle_sr(std::uint32_t n, std::uint32_t row, std::uint32_t column) {
    const double width = 2.0 / n;
    const double u0 = column * width - 1.0;
    const double v0 = row * width - 1.0;
    return solid_angle_sr(u0, v0, u0 + width, v0 + width);
}

}  // namespace relume::basis
