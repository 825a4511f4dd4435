#include "precompute/bake/visibility.h"

#include <algorithm>
#include <array>
#include <bit>

namespace relume::bake {
namespace {

// States of a texel; two neighbours disagree when their states together have both bits.
constexpr std::uint8_t kUnknown = 0;
constexpr std::uint8_t kBlocked = 1;
constexpr std::uint8_t kOpen = 2;

// x in [0, 2) to [0, 1).
float wrap_once(float x) {
    return x >= 1 ? x - 1 : x;
}

}  // namespace

Visibility::Visibility(const RayCaster& caster,
                       const LightTexels& texels,
                       std::uint32_t edge_samples)
    : caster_(caster), texels_(texels) {
    // Roberts' R2 sequence: any number of points, evenly spread on the torus.
    constexpr double kFirst = 0.7548776662466927;
    constexpr double kSecond = 0.5698402909980532;
    for (std::uint32_t i = 0; i <= edge_samples; ++i) {
        const double x = i * kFirst;
        const double y = i * kSecond;
        samples_.emplace_back(static_cast<float>(x - static_cast<std::uint32_t>(x)),
                              static_cast<float>(y - static_cast<std::uint32_t>(y)));
    }
}

void Visibility::compute(const Imath::V3f& origin,
                         const JitterShift& shift,
                         std::span<const float> wanted,
                         std::span<float> open,
                         Scratch& scratch) const {
    const std::size_t side = texels_.face_resolution() + 2;
    scratch.state.assign(basis::kFaceCount * side * side, kUnknown);
    cast_first(origin, shift, wanted, open, scratch);
    if (samples_.size() > 1) {
        find_edges(scratch);
        refine_edges(origin, shift, open, scratch);
    }
}

void Visibility::cast_first(const Imath::V3f& origin,
                            const JitterShift& shift,
                            std::span<const float> wanted,
                            std::span<float> open,
                            Scratch& scratch) const {
    const std::size_t n = texels_.face_resolution();
    const std::size_t side = n + 2;
    alignas(64) std::array<float, kPacketSize> columns;
    alignas(64) std::array<float, kPacketSize> rows;
    DirectionPacket directions;
    for (std::size_t packet = 0; packet < texels_.packet_count(); ++packet) {
        const std::size_t first = packet * kPacketSize;
        std::uint32_t mask = 0;
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            mask |= wanted[first + lane] != 0 ? 1U << lane : 0U;
        }
        if (mask == 0) {
            std::fill_n(&open[first], kPacketSize, 0.0F);
            continue;
        }
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            columns[lane] =
                wrap_once(texels_.jitter_column()[first + lane] + shift.column[lane]);
            rows[lane] = wrap_once(texels_.jitter_row()[first + lane] + shift.row[lane]);
        }
        texels_.cube_points(packet, columns, rows, directions);
        const std::uint32_t free = caster_.unoccluded(origin, directions, mask);
        scratch.rays += static_cast<std::uint64_t>(std::popcount(mask));
        const std::size_t texel = texels_.texel_index(first);
        const std::size_t face = texel / (n * n);
        const std::size_t row = texel / n % n;
        std::uint8_t* state = &scratch.state[(face * side + row + 1) * side + texel % n + 1];
        for (std::size_t lane = 0; lane < kPacketSize; ++lane) {
            const std::uint32_t is_open = (free >> lane) & 1U;
            const std::uint32_t is_wanted = (mask >> lane) & 1U;
            open[first + lane] = static_cast<float>(is_open);
            state[lane / LightTexels::kTileSide * side + lane % LightTexels::kTileSide] =
                static_cast<std::uint8_t>(is_wanted * (kBlocked + is_open));
        }
    }
}

void Visibility::find_edges(Scratch& scratch) const {
    const std::size_t n = texels_.face_resolution();
    const std::size_t side = n + 2;
    scratch.edges.clear();
    for (std::size_t face = 0; face < basis::kFaceCount; ++face) {
        for (std::size_t row = 0; row < n; ++row) {
            const std::uint8_t* state = &scratch.state[(face * side + row + 1) * side + 1];
            for (std::size_t column = 0; column < n; ++column) {
                const std::uint8_t* at = state + column;
                const unsigned around = unsigned{at[1]} | *(at - 1) | at[side] | *(at - side);
                if (around == (kBlocked | kOpen) && *at != kUnknown) {
                    scratch.edges.push_back(static_cast<std::uint32_t>(
                        texels_.place_from_texel_index((face * n + row) * n + column)));
                }
            }
        }
    }
}

Imath::V3f Visibility::direction(std::size_t place,
                                 const JitterShift& shift,
                                 std::uint32_t sample) const {
    const Imath::V2f& offset = samples_[sample];
    const std::size_t lane = place % kPacketSize;
    const float column = wrap_once(texels_.jitter_column()[place] + shift.column[lane]);
    const float row = wrap_once(texels_.jitter_row()[place] + shift.row[lane]);
    return texels_.cube_point(place, wrap_once(column + offset.x), wrap_once(row + offset.y));
}

void Visibility::refine_edges(const Imath::V3f& origin,
                              const JitterShift& shift,
                              std::span<float> open,
                              Scratch& scratch) const {
    const auto extra = static_cast<std::uint32_t>(samples_.size() - 1);
    std::array<std::uint32_t, kPacketSize> places{};
    DirectionPacket directions;
    std::uint32_t lane = 0;
    const auto cast = [&] {
        const std::uint32_t free = caster_.unoccluded(origin, directions, (1U << lane) - 1);
        for (std::uint32_t i = 0; i < lane; ++i) {
            open[places[i]] += static_cast<float>((free >> i) & 1U);
        }
        scratch.rays += lane;
        lane = 0;
    };
    for (const std::uint32_t place : scratch.edges) {
        for (std::uint32_t sample = 1; sample <= extra; ++sample) {
            const Imath::V3f d = direction(place, shift, sample);
            directions.x[lane] = d.x;
            directions.y[lane] = d.y;
            directions.z[lane] = d.z;
            places[lane] = place;
            if (++lane == kPacketSize) {
                cast();
            }
        }
    }
    if (lane > 0) {
        cast();
    }
    const float weight = 1.0F / static_cast<float>(extra + 1);
    for (const std::uint32_t place : scratch.edges) {
        open[place] *= weight;
    }
}

}  // namespace relume::bake
