#include "precompute/bake/fields/point_visibility.h"

#include <algorithm>
#include <bit>

namespace relume::bake {
namespace {

constexpr std::uint32_t kAllLanes = 0xFFFF;

float wrapped(float x) {
    return x >= 1 ? x - 1 : x;
}

}  // namespace

std::uint32_t PointVisibility::aim(const LookingPoint& point,
                                   std::size_t packet,
                                   RayPacket& rays) const {
    const Imath::V3f& normal = point.geometric_normal;
    const float height = texels_.packet_direction(packet).dot(normal);
    const float radius = texels_.packet_sine_radius(packet);
    if (height < -radius) {
        return 0;
    }
    const std::size_t first = packet * kPacketSize;
    alignas(64) std::array<float, kPacketSize> columns;
    alignas(64) std::array<float, kPacketSize> rows;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        columns[lane] =
            wrapped(texels_.jitter_column()[first + lane] + point.shift.column[lane]);
        rows[lane] = wrapped(texels_.jitter_row()[first + lane] + point.shift.row[lane]);
    }
    texels_.cube_points(packet, columns, rows, rays);
    if (height > radius) {
        return kAllLanes;
    }
    // At the horizon: the first of a few places of the texel that lies above.
    constexpr std::uint32_t kTries = 16;
    constexpr float kColumnStep = 0.75487767F;  // Roberts' R2 sequence
    constexpr float kRowStep = 0.56984029F;
    std::uint32_t above = 0;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        float column = columns[lane];
        float row = rows[lane];
        for (std::uint32_t tries = 0; tries < kTries; ++tries) {
            const Imath::V3f direction = texels_.cube_point(first + lane, column, row);
            if (direction.dot(normal) > 0) {
                rays.x()[lane] = direction.x;
                rays.y()[lane] = direction.y;
                rays.z()[lane] = direction.z;
                above |= 1U << lane;
                break;
            }
            column = wrapped(column + kColumnStep);
            row = wrapped(row + kRowStep);
        }
    }
    return above;
}

void PointVisibility::compute(const LookingPoint& point,
                              std::span<std::uint64_t> bits,
                              std::uint64_t& rays) const {
    constexpr std::uint32_t kSide = LightTexels::kPacketSide;
    const std::size_t n = texels_.face_resolution();
    std::fill(bits.begin(), bits.end(), std::uint64_t{0});
    RayPacket packet(point.origins);
    for (std::size_t i = 0; i < texels_.packet_count(); ++i) {
        const std::uint32_t wanted = aim(point, i, packet);
        if (wanted == 0) {
            continue;
        }
        const std::uint32_t open = caster_.unoccluded(packet, wanted);
        rays += static_cast<std::uint64_t>(std::popcount(wanted));
        // Four texels of a row begin at a multiple of four, so that no word is left.
        const std::size_t corner = texels_.texel_index(i * kPacketSize);
        for (std::uint32_t row = 0; row < kSide; ++row) {
            const std::size_t texel = corner + row * n;
            const std::uint64_t four = (open >> (row * kSide)) & 0xFU;
            bits[texel / 64] |= four << (texel % 64);
        }
    }
}

}  // namespace relume::bake
