#include "precompute/bake/fields/point_visibility.h"

#include <algorithm>
#include <bit>

namespace relume::bake {
namespace {

constexpr std::uint32_t kAllLanes = 0xFFFF;

float wrapped(float x) {
    return x >= 1 ? x - 1 : x;
}

// The first of a few places of a texel, from the one at these offsets on, that lies above the
// surface; false where none does.
bool aim_above(const LightTexels& texels,
               std::size_t place,
               float column,
               float row,
               const Imath::V3f& normal,
               Imath::V3f& direction) {
    constexpr std::uint32_t kTries = 16;
    constexpr float kColumnStep = 0.75487767F;  // Roberts' R2 sequence
    constexpr float kRowStep = 0.56984029F;
    for (std::uint32_t tries = 0; tries < kTries; ++tries) {
        direction = texels.cube_point(place, column, row);
        if (direction.dot(normal) > 0) {
            return true;
        }
        column = wrapped(column + kColumnStep);
        row = wrapped(row + kRowStep);
    }
    return false;
}

void set_lane(RayPacket& rays, std::size_t lane, const Imath::V3f& direction) {
    rays.x()[lane] = direction.x;
    rays.y()[lane] = direction.y;
    rays.z()[lane] = direction.z;
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
    // At the horizon.
    std::uint32_t above = 0;
    Imath::V3f direction;
    for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
        if (aim_above(texels_, first + lane, columns[lane], rows[lane], normal, direction)) {
            set_lane(rays, lane, direction);
            above |= 1U << lane;
        }
    }
    return above;
}

void PointVisibility::compute(const LookingPoint& point,
                              std::span<std::uint64_t> bits,
                              Scratch& scratch) const {
    if (point.looks_again) {
        look_again(point, bits, scratch);
        return;
    }
    look(point, bits, scratch);
    scratch.bits.assign(bits.begin(), bits.end());
    scratch.edges.find();
    scratch.edge_texels = scratch.edges.near();
    scratch.edge_texels.insert(scratch.edge_texels.end(), scratch.edges.around().begin(),
                               scratch.edges.around().end());
}

void PointVisibility::look(const LookingPoint& point,
                           std::span<std::uint64_t> bits,
                           Scratch& scratch) const {
    constexpr std::uint32_t kSide = LightTexels::kPacketSide;
    const std::size_t n = texels_.face_resolution();
    std::fill(bits.begin(), bits.end(), std::uint64_t{0});
    scratch.edges.reset(n);
    const std::size_t stride = scratch.edges.row_stride();
    RayPacket packet(point.origins);
    for (std::size_t i = 0; i < texels_.packet_count(); ++i) {
        const std::uint32_t wanted = aim(point, i, packet);
        if (wanted == 0) {
            continue;
        }
        const std::uint32_t open = caster_.unoccluded(packet, wanted);
        scratch.rays += static_cast<std::uint64_t>(std::popcount(wanted));
        // Four texels of a row begin at a multiple of four, so that no word is left.
        const std::size_t corner = texels_.texel_index(i * kPacketSize);
        for (std::uint32_t row = 0; row < kSide; ++row) {
            const std::size_t texel = corner + row * n;
            const std::uint64_t four = (open >> (row * kSide)) & 0xFU;
            bits[texel / 64] |= four << (texel % 64);
        }
        std::uint8_t* state = scratch.edges.state(corner);
        for (std::uint32_t lane = 0; lane < kPacketSize; ++lane) {
            state[lane / kSide * stride + lane % kSide] = static_cast<std::uint8_t>(
                ((wanted >> lane) & 1U) * (TexelState::kBlocked + ((open >> lane) & 1U)));
        }
    }
}

void PointVisibility::look_again(const LookingPoint& point,
                                 std::span<std::uint64_t> bits,
                                 Scratch& scratch) const {
    std::copy(scratch.bits.begin(), scratch.bits.end(), bits.begin());
    RayPacket packet(point.origins);
    const std::vector<std::uint32_t>& edges = scratch.edge_texels;
    Imath::V3f direction;
    for (std::size_t first = 0; first < edges.size(); first += kPacketSize) {
        const std::size_t lanes = std::min(kPacketSize, edges.size() - first);
        std::uint32_t wanted = 0;
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t place = texels_.place_from_texel_index(edges[first + lane]);
            const std::size_t own = place % kPacketSize;
            if (aim_above(texels_, place,
                          wrapped(texels_.jitter_column()[place] + point.shift.column[own]),
                          wrapped(texels_.jitter_row()[place] + point.shift.row[own]),
                          point.geometric_normal, direction)) {
                set_lane(packet, lane, direction);
                wanted |= 1U << lane;
            }
        }
        const std::uint32_t open = caster_.unoccluded(packet, wanted);
        scratch.rays += static_cast<std::uint64_t>(std::popcount(wanted));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t texel = edges[first + lane];
            const std::uint64_t bit = std::uint64_t{1} << (texel % 64);
            bits[texel / 64] &= ~bit;
            bits[texel / 64] |= ((open >> lane) & 1U) != 0 ? bit : 0;
        }
    }
}

}  // namespace relume::bake
