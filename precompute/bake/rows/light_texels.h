// The texels of the lighting cubemap in the order in which rays are cast at them.
//
// A *place* is an index in that order: squares of 4×4 texels, a packet of sixteen rays each,
// the squares of a face along a Morton curve, so that what follows is close to what went
// before.
#pragma once

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/bake/rows/spherical_polygon.h"
#include "protocol/basis/cubemap.h"

#include <Imath/ImathVec.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relume::bake {

class LightTexels {
  public:
    // Texels along a side of the square that a packet of rays is cast at.
    static constexpr std::uint32_t kPacketSide = 4;
    static_assert(kPacketSide * kPacketSide == kPacketSize);

    // `face_resolution` as in basis/cubemap.h; `seed` chooses the jitter.
    LightTexels(std::uint32_t face_resolution, std::uint64_t seed);

    [[nodiscard]] std::uint32_t face_resolution() const { return face_resolution_; }
    [[nodiscard]] std::size_t size() const { return solid_angle_.size(); }
    [[nodiscard]] std::size_t packet_count() const { return squares_.size(); }

    // By place. ∫ ω dω of a texel is `direction · irradiance`; `direction` is unit and is the
    // texel's centroid.
    [[nodiscard]] std::span<const float> direction_x() const { return x_; }
    [[nodiscard]] std::span<const float> direction_y() const { return y_; }
    [[nodiscard]] std::span<const float> direction_z() const { return z_; }
    [[nodiscard]] std::span<const float> irradiance() const { return irradiance_; }
    [[nodiscard]] std::span<const float> solid_angle_sr() const { return solid_angle_; }
    // The largest sine of the angle between a texel's centroid and its corners, in the packet.
    [[nodiscard]] float sine_radius(std::size_t packet) const { return sine_radius_[packet]; }
    // Unit direction to the middle of a packet, and the sine of the angle to its corners.
    [[nodiscard]] const Imath::V3f& packet_direction(std::size_t packet) const {
        return packet_direction_[packet];
    }
    [[nodiscard]] float packet_sine_radius(std::size_t packet) const {
        return packet_sine_radius_[packet];
    }
    // Uniform in [0,1), fixed for each place.
    [[nodiscard]] std::span<const float> jitter_column() const { return jitter_column_; }
    [[nodiscard]] std::span<const float> jitter_row() const { return jitter_row_; }

    [[nodiscard]] SphericalPolygon polygon(std::size_t place) const;
    // Not normalised; offsets from the texel's corner in [0, 1].
    [[nodiscard]] Imath::V3f cube_point(std::size_t place,
                                        float column_offset,
                                        float row_offset) const {
        const Square& square = squares_[place / kPacketSize];
        const auto lane = static_cast<std::uint32_t>(place % kPacketSize);
        return square.origin +
               square.columns * (static_cast<float>(lane % kPacketSide) + column_offset) +
               square.rows * (static_cast<float>(lane / kPacketSide) + row_offset);
    }
    // The same for all places of a packet at once, as directions of rays.
    void cube_points(std::size_t packet,
                     std::span<const float, kPacketSize> column_offset,
                     std::span<const float, kPacketSize> row_offset,
                     RayPacket& points) const;

    // From one column, and one row, to the next on the cube.
    [[nodiscard]] const Imath::V3f& column_step(std::size_t place) const {
        return squares_[place / kPacketSize].columns;
    }
    [[nodiscard]] const Imath::V3f& row_step(std::size_t place) const {
        return squares_[place / kPacketSize].rows;
    }

    [[nodiscard]] std::size_t texel_index(std::size_t place) const;
    [[nodiscard]] std::size_t place_from_texel_index(std::size_t index) const {
        return place_from_texel_index_[index];
    }
    // From the order of places to row-major texels.
    void scatter(std::span<const float> by_place, std::span<float> by_texel) const;

  private:
    struct Square {
        Imath::V3f origin;   // cube point of the square's corner
        Imath::V3f columns;  // from one column to the next
        Imath::V3f rows;     // from one row to the next
        std::uint32_t first_texel = 0;
    };

    void add_square(basis::Face face, std::uint32_t row, std::uint32_t column);

    std::uint32_t face_resolution_;
    std::vector<Square> squares_;
    std::vector<float> x_, y_, z_, irradiance_, solid_angle_;
    std::vector<float> jitter_column_, jitter_row_;
    std::vector<float> sine_radius_;
    std::vector<Imath::V3f> packet_direction_;
    std::vector<float> packet_sine_radius_;
    std::vector<std::uint32_t> place_from_texel_index_;
};

}  // namespace relume::bake
