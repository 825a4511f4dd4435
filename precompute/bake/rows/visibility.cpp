#include "precompute/bake/rows/visibility.h"

#include "protocol/basis/cpu_clones.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace relume::bake {
namespace {

// Of the further rays at an edge, the part that goes where only the wider surroundings
// disagree: such a texel is less likely to be cut, and there are more of them.
constexpr float kOfNear = 0.5F;

// x in [0, 2) to [0, 1).
inline float wrap_once(float x) {
    return x >= 1 ? x - 1 : x;
}

// Bits of the lanes that are not zero.
RELUME_CPU_CLONES std::uint32_t nonzero_lanes(const float* values) {
    std::uint32_t lanes = 0;
    for (std::uint32_t i = 0; i < kPacketSize; ++i) {
        lanes += values[i] != 0 ? 1U << i : 0U;
    }
    return lanes;
}

RELUME_CPU_CLONES void add_wrapped(const float* a, const float* b, float* sum) {
    for (std::size_t i = 0; i < kPacketSize; ++i) {
        sum[i] = wrap_once(a[i] + b[i]);
    }
}

// 1.0 where the lane is open; the state beside it.
RELUME_CPU_CLONES void spread_lanes(std::uint32_t wanted,
                                    std::uint32_t free,
                                    float* open,
                                    std::uint32_t* state) {
    for (std::uint32_t i = 0; i < kPacketSize; ++i) {
        const std::uint32_t is_open = (free >> i) & 1U;
        open[i] = static_cast<float>(static_cast<int>(is_open));
        state[i] = ((wanted >> i) & 1U) * (TexelState::kBlocked + is_open);
    }
}

// One coordinate of the points of a texel at the wrapped offsets start + samples.
RELUME_CPU_CLONES void aim(float corner,
                           float columns,
                           float rows,
                           float column_start,
                           float row_start,
                           std::span<const float> column_samples,
                           std::span<const float> row_samples,
                           float* points) {
    const std::size_t count = column_samples.size();
    for (std::size_t i = 0; i < count; ++i) {
        points[i] = corner + columns * wrap_once(column_start + column_samples[i]) +
                    rows * wrap_once(row_start + row_samples[i]);
    }
}

}  // namespace

Visibility::Visibility(const RayCaster& caster,
                       const LightTexels& texels,
                       std::uint32_t edge_samples)
    : caster_(caster), texels_(texels) {
    // Roberts' R2 sequence: any number of points, evenly spread on the torus.
    constexpr double kFirst = 0.7548776662466927;
    constexpr double kSecond = 0.5698402909980532;
    for (std::uint32_t i = 1; i <= edge_samples; ++i) {
        const double x = i * kFirst;
        const double y = i * kSecond;
        column_samples_.push_back(static_cast<float>(x - static_cast<std::uint32_t>(x)));
        row_samples_.push_back(static_cast<float>(y - static_cast<std::uint32_t>(y)));
    }
}

void Visibility::compute(const std::array<Imath::V3f, kPacketSize>& origins,
                         float share,
                         const JitterShift& shift,
                         std::span<const float> wanted,
                         std::span<float> open,
                         Scratch& scratch) const {
    scratch.edges.reset(texels_.face_resolution());
    RayPacket packet(origins);
    cast_first(packet, shift, wanted, open, scratch);
    if (!column_samples_.empty()) {
        scratch.edges.find();
        const float most = share * static_cast<float>(column_samples_.size());
        refine(packet, shift, scratch.edges.near(), most, open, scratch);
        refine(packet, shift, scratch.edges.around(), kOfNear * most, open, scratch);
    }
}

void Visibility::cast_first(RayPacket& packet,
                            const JitterShift& shift,
                            std::span<const float> wanted,
                            std::span<float> open,
                            Scratch& scratch) const {
    const std::size_t side = scratch.edges.row_stride();
    alignas(64) std::array<float, kPacketSize> columns;
    alignas(64) std::array<float, kPacketSize> rows;
    alignas(64) std::array<std::uint32_t, kPacketSize> states;
    for (std::size_t i = 0; i < texels_.packet_count(); ++i) {
        const std::size_t first = i * kPacketSize;
        const std::uint32_t mask = nonzero_lanes(&wanted[first]);
        if (mask == 0) {
            std::fill_n(&open[first], kPacketSize, 0.0F);
            continue;
        }
        add_wrapped(&texels_.jitter_column()[first], shift.column.data(), columns.data());
        add_wrapped(&texels_.jitter_row()[first], shift.row.data(), rows.data());
        texels_.cube_points(i, columns, rows, packet);
        const std::uint32_t free = caster_.unoccluded(packet, mask);
        scratch.rays += static_cast<std::uint64_t>(std::popcount(mask));
        spread_lanes(mask, free, &open[first], states.data());
        std::uint8_t* state = scratch.edges.state(texels_.texel_index(first));
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            state[lane / LightTexels::kPacketSide * side + lane % LightTexels::kPacketSide] =
                static_cast<std::uint8_t>(states[lane]);
        }
    }
}

void Visibility::refine(RayPacket& packet,
                        const JitterShift& shift,
                        std::span<const std::uint32_t> edges,
                        float most,
                        std::span<float> open,
                        Scratch& scratch) const {
    const auto extra = static_cast<std::size_t>(std::ceil(most));
    scratch.places.clear();
    for (const std::uint32_t texel : edges) {
        scratch.places.push_back(
            static_cast<std::uint32_t>(texels_.place_from_texel_index(texel)));
    }
    aim_at_edges(shift, scratch.places, extra, scratch);
    cast_at_edges(packet, scratch.places, extra, open, scratch);
}

// Directions of all further rays, edge by edge.
void Visibility::aim_at_edges(const JitterShift& shift,
                              std::span<const std::uint32_t> edges,
                              std::size_t extra,
                              Scratch& scratch) const {
    for (auto& plane : scratch.directions) {
        plane.resize(edges.size() * extra);
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::size_t place = edges[i];
        const std::size_t lane = place % kPacketSize;
        const float column = wrap_once(texels_.jitter_column()[place] + shift.column[lane]);
        const float row = wrap_once(texels_.jitter_row()[place] + shift.row[lane]);
        const Imath::V3f corner = texels_.cube_point(place, 0, 0);
        for (int axis = 0; axis < 3; ++axis) {
            aim(corner[axis], texels_.column_step(place)[axis], texels_.row_step(place)[axis],
                column, row, std::span(column_samples_).first(extra),
                std::span(row_samples_).first(extra),
                &scratch.directions[static_cast<std::size_t>(axis)][i * extra]);
        }
    }
}

void Visibility::cast_at_edges(RayPacket& packet,
                               std::span<const std::uint32_t> edges,
                               std::size_t extra,
                               std::span<float> open,
                               Scratch& scratch) const {
    const std::size_t count = edges.size() * extra;
    for (std::size_t first = 0; first < count; first += kPacketSize) {
        const std::size_t lanes = std::min(kPacketSize, count - first);
        std::copy_n(&scratch.directions[0][first], lanes, packet.x());
        std::copy_n(&scratch.directions[1][first], lanes, packet.y());
        std::copy_n(&scratch.directions[2][first], lanes, packet.z());
        std::uint32_t free =
            caster_.unoccluded(packet, static_cast<std::uint32_t>((1U << lanes) - 1));
        for (; free != 0; free &= free - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(free));
            open[edges[(first + lane) / extra]] += 1;
        }
    }
    scratch.rays += count;
    const float weight = 1.0F / static_cast<float>(extra + 1);
    for (const std::uint32_t place : edges) {
        open[place] *= weight;
    }
}

}  // namespace relume::bake
