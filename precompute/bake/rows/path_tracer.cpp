#include "precompute/bake/rows/path_tracer.h"

#include "protocol/basis/cubemap.h"
#include "protocol/sampling/sobol.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace relume::bake {
namespace {

// From this scattering event on, dark paths may end early.
constexpr std::uint32_t kFirstRoulette = 4;
constexpr float kMostSurvive = 0.95F;

float largest(const Imath::V3f& v) {
    return std::max({v.x, v.y, v.z});
}

// The weight of the first sample over the surface's reflectance. Of Lambert it is one, also
// where the albedo is zero.
Imath::V3f demodulated(const scene::Bsdf& bsdf, const Imath::V3f& weight) {
    if (bsdf.is_diffuse()) {
        return {1, 1, 1};
    }
    return weight / reflectance(bsdf);
}

}  // namespace

std::size_t texel_index_from_key(std::uint32_t face_resolution, std::uint32_t key) {
    const std::uint32_t face_size = face_resolution * face_resolution;
    const std::uint32_t morton = key % face_size;
    return basis::index_from_texel(face_resolution,
                                   {.face = static_cast<basis::Face>(key / face_size),
                                    .row = sampling::morton_even(morton >> 1U),
                                    .column = sampling::morton_even(morton)});
}

Imath::V3f reflectance(const scene::Bsdf& bsdf) {
    if (bsdf.is_diffuse()) {
        return bsdf.diffuse_colour();
    }
    constexpr float kDarkest = 0.02F;  // a division that must not blow up
    const Imath::V3f sum = bsdf.diffuse_colour() + bsdf.specular_colour();
    return {std::max(sum.x, kDarkest), std::max(sum.y, kDarkest), std::max(sum.z, kDarkest)};
}

TracedReceiver PathTracer::trace(Receiver receiver) const {
    TracedReceiver traced{.receiver = std::move(receiver), .paths = {}};
    if (bounces_ > 0) {
        for (const ReceiverSurface& surface : traced.receiver.surfaces) {
            traced.paths.push_back(trace_surface(surface, traced.receiver.place));
        }
    }
    return traced;
}

SurfacePaths PathTracer::trace_surface(const ReceiverSurface& surface,
                                       const SequencePlace& place) const {
    SurfacePaths paths;
    paths.paths = std::max(1U, static_cast<std::uint32_t>(
                                   std::lround(surface.share * static_cast<float>(samples_))));
    const std::uint64_t key = transport::mix_bits(seed_ + 1) + surface.number;
    const std::uint32_t first = place.run * samples_;
    for (std::uint32_t i = 0; i < paths.paths; ++i) {
        trace_path(surface, i, first + i, key, paths);
    }
    paths.nearness /= static_cast<float>(paths.paths);
    return paths;
}

void PathTracer::trace_path(const ReceiverSurface& surface,
                            std::uint32_t number,
                            std::uint32_t index,
                            std::uint64_t key,
                            SurfacePaths& paths) const {
    scene::SurfacePoint point =
        surface.turns.empty() ? surface.point : surface.turns[number % surface.turns.size()];
    Imath::V3f origin =
        surface.turns.empty() ? surface.origins[number % kPacketSize] : offset_origin(point);
    Imath::V3f weight{1, 1, 1};
    for (std::uint32_t event = 0;; ++event) {
        const std::uint64_t dimension = transport::mix_bits(key) + 2 * std::uint64_t{event};
        const std::uint32_t directions = looks(event, samples_);
        if (directions > 0) {
            look_at_sky(point, weight, directions, index, ~dimension, paths);
            if (event == bounces_) {
                return;
            }
        }
        const scene::SurfacePoint::Sample sample =
            point.sample(sampling::sobol_point(index, dimension + 1).x,
                         sampling::sobol_point(index, dimension));
        if (sample.pdf <= 0 || largest(sample.weight) <= 0) {
            if (!(event == 0 && point.bsdf.is_diffuse() && sample.pdf > 0 &&
                  point.is_above_surface(sample.wi))) {
                return;
            }
        }
        weight *= event == 0 ? demodulated(point.bsdf, sample.weight) : sample.weight;
        if (event == 0 && surface.brdf != nullptr) {
            paths.starts.push_back(
                {.direction = sample.wi,
                 .first_escape = static_cast<std::uint32_t>(paths.escapes.size())});
        }
        const auto hit = caster_.closest_hit(origin, sample.wi);
        ++paths.rays;
        if (!hit) {
            if (event > 0 && directions == 0) {  // else it is direct light, or was looked at
                paths.escapes.push_back({.weight = weight, .count = 1});
                paths.texels.push_back(key_from_direction(sample.wi));
            }
            return;
        }
        if (event == 0) {
            paths.nearness += 1.0F / std::max(hit->distance, surface.footprint);
        }
        if (event == bounces_) {
            return;
        }
        if (event >= kFirstRoulette) {
            const float survive = std::min(largest(weight), kMostSurvive);
            if (sampling::sobol_point(index, dimension + 1).y >= survive) {
                return;
            }
            weight /= survive;
        }
        point = scene::surface_point(caster_.scene(), hit->mesh, hit->triangle,
                                     hit->barycentric, sample.wi);
        origin = offset_origin(point);
    }
}

void PathTracer::look_at_sky(const scene::SurfacePoint& point,
                             const Imath::V3f& weight,
                             std::uint32_t looks,
                             std::uint32_t index,
                             std::uint64_t dimension,
                             SurfacePaths& paths) const {
    RayPacket packet(offset_origin(point));
    std::array<scene::SurfacePoint::Sample, kPacketSize> samples;
    std::uint32_t wanted = 0;
    for (std::uint32_t i = 0; i < looks; ++i) {
        // An aligned run of a sequence is stratified by itself.
        const std::uint32_t at = index * looks + i;
        samples[i] = point.sample(sampling::sobol_point(at, dimension + 1).x,
                                  sampling::sobol_point(at, dimension));
        packet.x()[i] = samples[i].wi.x;
        packet.y()[i] = samples[i].wi.y;
        packet.z()[i] = samples[i].wi.z;
        wanted |= samples[i].pdf > 0 && largest(samples[i].weight) > 0 ? 1U << i : 0U;
    }
    std::uint32_t open = caster_.unoccluded(packet, wanted);
    paths.rays += static_cast<std::uint64_t>(std::popcount(wanted));
    const Imath::V3f each = weight / static_cast<float>(looks);
    // Of a Lambert surface all weights are one, and kept once.
    const Imath::V3f* last = nullptr;
    for (; open != 0; open &= open - 1) {
        const auto& [wi, sample_weight, pdf] =
            samples[static_cast<std::size_t>(std::countr_zero(open))];
        if (last == nullptr || *last != sample_weight) {
            paths.escapes.push_back({.weight = each * sample_weight, .count = 0});
            last = &sample_weight;
        }
        ++paths.escapes.back().count;
        paths.texels.push_back(key_from_direction(wi));
    }
}

std::uint32_t PathTracer::key_from_direction(const Imath::V3f& direction) const {
    const basis::Texel texel = basis::texel_from_direction(face_resolution_, direction);
    return texel_key(face_resolution_, static_cast<std::uint32_t>(texel.face),
                     sampling::morton_index(texel.column, texel.row));
}

std::uint32_t PathTracer::looks(std::uint32_t event, std::uint32_t samples) {
    // Of light that was scattered twice little is left.
    constexpr std::uint32_t kLastEvent = 3;
    constexpr std::uint32_t kOfReceiver = 2048;
    constexpr std::uint32_t kLaterOfReceiver = 512;
    constexpr std::uint32_t kLaterOfPath = 4;
    if (event == 0 || event > kLastEvent) {
        return 0;
    }
    const std::uint32_t count =
        event == 1 ? std::min(kOfReceiver / samples, static_cast<std::uint32_t>(kPacketSize))
                   : std::min(kLaterOfReceiver / samples, kLaterOfPath);
    return count > 1 ? count : 0;
}

std::uint64_t PathTracer::most_bytes(std::uint32_t bounces, std::uint32_t samples) {
    std::uint64_t escapes = 1;
    for (std::uint32_t event = 1; event <= bounces && looks(event, samples) > 0; ++event) {
        escapes += looks(event, samples);
    }
    return samples * escapes * (sizeof(Escapes) + sizeof(std::uint32_t));
}

}  // namespace relume::bake
