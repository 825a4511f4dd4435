#include "precompute/bake/rows/direct_light.h"

#include "precompute/bake/rows/jitter_shift.h"
#include "protocol/basis/cpu_clones.h"

#include <algorithm>
#include <bit>

namespace relume::bake {
namespace {

RELUME_CPU_CLONES void add_scaled(std::span<const float> source,
                                  float factor,
                                  std::span<float> target) {
    for (std::size_t i = 0; i < source.size(); ++i) {
        target[i] += factor * source[i];
    }
}

RELUME_CPU_CLONES void multiply(std::span<const float> factors, std::span<float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] *= factors[i];
    }
}

// Their parts are added one by one.
void leave_out_split_texels(Reflection& reflection) {
    for (const SplitTexel& split : reflection.split) {
        for (auto& plane : reflection.rgb) {
            plane[split.place] = 0;
        }
    }
}

}  // namespace

DirectLight::DirectLight(const RayCaster& caster,
                         const LightTexels& texels,
                         std::uint32_t edge_samples)
    : caster_(caster), texels_(texels), visibility_(caster, texels, edge_samples) {}

void DirectLight::compute(const Receiver& receiver,
                          std::uint64_t seed,
                          TexelRow& row,
                          Scratch& scratch) const {
    const std::vector<ReceiverSurface>& surfaces = receiver.surfaces;
    scratch.open.resize(texels_.size());
    scratch.scattered.resize(texels_.size());
    row.is_grey =
        surfaces.empty() || (surfaces.size() == 1 && surfaces[0].point.bsdf.is_diffuse());
    row.colour = {0, 0, 0};
    for (std::size_t c = 0; c < (row.is_grey ? 1U : 3U); ++c) {
        row.plane[c].assign(texels_.size(), 0.0F);
    }
    for (const ReceiverSurface& surface : surfaces) {
        light_surface(surface, jitter_shift(receiver.place, surface.number, seed), scratch);
        Reflection& reflection = scratch.reflection;
        const Imath::V3f colour =
            surface.share *
            (reflection.is_diffuse ? surface.point.bsdf.diffuse_colour() : Imath::V3f(1, 1, 1));
        if (row.is_grey) {
            texels_.scatter(reflection.grey, row.plane[0]);
            row.colour = colour;
            return;
        }
        if (reflection.is_diffuse) {
            texels_.scatter(reflection.grey, scratch.scattered);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            if (!reflection.is_diffuse) {
                texels_.scatter(reflection.rgb[c], scratch.scattered);
            }
            add_scaled(scratch.scattered, colour[static_cast<int>(c)], row.plane[c]);
        }
    }
}

void DirectLight::light_surface(const ReceiverSurface& surface,
                                const JitterShift& shift,
                                Scratch& scratch) const {
    Reflection& reflection = scratch.reflection;
    if (surface.turns.empty()) {
        reflect_light(texels_, surface.point, reflection);
        leave_out_split_texels(reflection);
    } else {
        reflect_from_turns(surface, scratch);
    }
    std::vector<float>& open = scratch.open;
    if (reflection.is_diffuse) {
        visibility_.compute(surface.origins, surface.share, shift, reflection.grey, open,
                            scratch.visibility);
        multiply(open, reflection.grey);
        return;
    }
    visibility_.compute(surface.origins, surface.share, shift, reflection.projected, open,
                        scratch.visibility);
    for (auto& plane : reflection.rgb) {
        multiply(open, plane);
    }
    add_split_texels(surface, shift, scratch);
}

// The mean of the reflections of all turns.
void DirectLight::reflect_from_turns(const ReceiverSurface& surface, Scratch& scratch) const {
    const float each = 1 / static_cast<float>(surface.turns.size());
    Reflection& sum = scratch.reflection;
    Reflection& turn = scratch.turn;
    sum.is_diffuse = surface.point.bsdf.is_diffuse();
    sum.split.clear();
    for (auto* plane : {&sum.grey, &sum.projected, &sum.rgb[0], &sum.rgb[1], &sum.rgb[2]}) {
        plane->assign(texels_.size(), 0.0F);
    }
    for (const scene::SurfacePoint& point : surface.turns) {
        reflect_light(texels_, point, turn, TexelDetail::one_of_many);
        if (sum.is_diffuse) {
            add_scaled(turn.grey, each, sum.grey);
            continue;
        }
        leave_out_split_texels(turn);
        for (std::size_t c = 0; c < 3; ++c) {
            add_scaled(turn.rgb[c], each, sum.rgb[c]);
            for (SplitTexel& split : turn.split) {
                for (float& part : split.rgb[c]) {
                    part *= each;
                }
            }
        }
        for (std::size_t place = 0; place < sum.projected.size(); ++place) {
            sum.projected[place] = std::max(sum.projected[place], turn.projected[place]);
        }
        sum.split.insert(sum.split.end(), turn.split.begin(), turn.split.end());
    }
}

// Every part of a split texel has a ray of its own.
void DirectLight::add_split_texels(const ReceiverSurface& surface,
                                   const JitterShift& shift,
                                   Scratch& scratch) const {
    constexpr float kPart = 1.0F / LightTexels::kPacketSide;
    Reflection& reflection = scratch.reflection;
    RayPacket packet(surface.origins);
    for (const SplitTexel& split : reflection.split) {
        std::uint32_t wanted = 0;
        for (std::uint32_t part = 0; part < kPacketSize; ++part) {
            const auto column = static_cast<float>(part % LightTexels::kPacketSide);
            const auto row = static_cast<float>(part / LightTexels::kPacketSide);
            const Imath::V3f d =
                texels_.cube_point(split.place, (column + shift.column[part]) * kPart,
                                   (row + shift.row[part]) * kPart);
            packet.x()[part] = d.x;
            packet.y()[part] = d.y;
            packet.z()[part] = d.z;
            const bool reflects =
                split.rgb[0][part] + split.rgb[1][part] + split.rgb[2][part] > 0;
            wanted |= reflects ? 1U << part : 0U;
        }
        const std::uint32_t free = caster_.unoccluded(packet, wanted);
        scratch.visibility.rays += static_cast<std::uint64_t>(std::popcount(wanted));
        for (std::size_t c = 0; c < 3; ++c) {
            float total = 0;
            for (std::uint32_t part = 0; part < kPacketSize; ++part) {
                total += (free >> part) & 1U ? split.rgb[c][part] : 0.0F;
            }
            reflection.rgb[c][split.place] += total;
        }
    }
}

}  // namespace relume::bake
