#include "precompute/bake/rows/light_texels.h"

#include "protocol/basis/cpu_clones.h"
#include "protocol/sampling/sobol.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <cmath>

namespace relume::bake {
namespace {

float sine_between(const Imath::V3f& unit, const Imath::V3f& any) {
    return unit.cross(any).length() / any.length();
}

RELUME_CPU_CLONES void along_axis(float origin,
                                  float columns,
                                  float rows,
                                  const float* column_offset,
                                  const float* row_offset,
                                  float* points) {
    for (std::uint32_t lane = 0; lane < kPacketSize; ++lane) {
        const float column =
            static_cast<float>(lane % LightTexels::kPacketSide) + column_offset[lane];
        const float row =
            static_cast<float>(lane / LightTexels::kPacketSide) + row_offset[lane];
        points[lane] = origin + columns * column + rows * row;
    }
}

}  // namespace

LightTexels::LightTexels(std::uint32_t face_resolution, std::uint64_t seed)
    : face_resolution_(face_resolution) {
    const std::size_t count = basis::texel_count(face_resolution);
    place_from_texel_index_.resize(count);
    for (auto* plane :
         {&x_, &y_, &z_, &irradiance_, &solid_angle_, &jitter_column_, &jitter_row_}) {
        plane->reserve(count);
    }
    const std::uint32_t squares_per_side = face_resolution / kPacketSide;
    for (std::uint32_t face = 0; face < basis::kFaceCount; ++face) {
        for (std::uint32_t i = 0; i < squares_per_side * squares_per_side; ++i) {
            add_square(static_cast<basis::Face>(face),
                       sampling::morton_even(i >> 1U) * kPacketSide,
                       sampling::morton_even(i) * kPacketSide);
        }
    }
    for (std::size_t place = 0; place < count; ++place) {
        place_from_texel_index_[texel_index(place)] = static_cast<std::uint32_t>(place);
        const std::uint64_t bits = transport::mix_bits(transport::mix_bits(seed) + place);
        jitter_column_.push_back(transport::unit_float(bits));
        jitter_row_.push_back(transport::unit_float(bits << 32U));
    }
}

void LightTexels::add_square(basis::Face face, std::uint32_t row, std::uint32_t column) {
    const float texel = 2.0F / static_cast<float>(face_resolution_);
    const auto at = [&](float u, float v) {
        return basis::cube_point_from_face_point({face, u, v});
    };
    const Imath::V3f middle = at(0, 0);
    const Imath::V3f along_u = (at(1, 0) - middle) * texel;
    const Imath::V3f along_v = (at(0, 1) - middle) * texel;
    const float u = static_cast<float>(column) * texel - 1;
    const float v = static_cast<float>(row) * texel - 1;
    const std::size_t packet = squares_.size();
    squares_.push_back({.origin = at(u, v),
                        .columns = along_u,
                        .rows = along_v,
                        .first_texel = static_cast<std::uint32_t>(
                            basis::index_from_texel(face_resolution_, {face, row, column}))});
    float widest = 0;
    for (std::uint32_t lane = 0; lane < kPacketSize; ++lane) {
        const std::size_t place = packet * kPacketSize + lane;
        const Imath::V3d vector = polygon(place).vector_irradiance();
        const Imath::V3f direction(vector.normalized());
        x_.push_back(direction.x);
        y_.push_back(direction.y);
        z_.push_back(direction.z);
        irradiance_.push_back(static_cast<float>(vector.length()));
        solid_angle_.push_back(static_cast<float>(basis::solid_angle_sr(
            face_resolution_, row + lane / kPacketSide, column + lane % kPacketSide)));
        for (const float corner : {0.0F, 1.0F}) {
            widest = std::max({widest, sine_between(direction, cube_point(place, corner, 0)),
                               sine_between(direction, cube_point(place, corner, 1))});
        }
    }
    const Imath::V3f& origin = squares_.back().origin;
    const auto side = static_cast<float>(kPacketSide);
    const Imath::V3f centre = (origin + (along_u + along_v) * (0.5F * side)).normalized();
    float packet_widest = 0;
    for (const float corner : {0.0F, side}) {
        packet_widest =
            std::max({packet_widest, sine_between(centre, origin + along_u * corner),
                      sine_between(centre, origin + along_u * corner + along_v * side)});
    }
    // Rounding must not make a texel at the horizon look as if it were clear of it.
    constexpr float kSlack = 1e-6F;
    sine_radius_.push_back(widest + kSlack);
    packet_direction_.push_back(centre);
    packet_sine_radius_.push_back(packet_widest + kSlack);
}

SphericalPolygon LightTexels::polygon(std::size_t place) const {
    return SphericalPolygon(
        {Imath::V3d(cube_point(place, 0, 0)), Imath::V3d(cube_point(place, 1, 0)),
         Imath::V3d(cube_point(place, 1, 1)), Imath::V3d(cube_point(place, 0, 1))});
}

void LightTexels::cube_points(std::size_t packet,
                              std::span<const float, kPacketSize> column_offset,
                              std::span<const float, kPacketSize> row_offset,
                              RayPacket& points) const {
    const Square& square = squares_[packet];
    const std::array<float*, 3> planes{points.x(), points.y(), points.z()};
    for (int axis = 0; axis < 3; ++axis) {
        along_axis(square.origin[axis], square.columns[axis], square.rows[axis],
                   column_offset.data(), row_offset.data(),
                   planes[static_cast<std::size_t>(axis)]);
    }
}

std::size_t LightTexels::texel_index(std::size_t place) const {
    const std::size_t lane = place % kPacketSize;
    return squares_[place / kPacketSize].first_texel + (lane / kPacketSide) * face_resolution_ +
           lane % kPacketSide;
}

void LightTexels::scatter(std::span<const float> by_place, std::span<float> by_texel) const {
    for (std::size_t packet = 0; packet < squares_.size(); ++packet) {
        const float* source = &by_place[packet * kPacketSize];
        float* target = &by_texel[squares_[packet].first_texel];
        for (std::size_t row = 0; row < kPacketSide; ++row) {
            std::copy_n(source + row * kPacketSide, kPacketSide,
                        target + row * face_resolution_);
        }
    }
}

}  // namespace relume::bake
