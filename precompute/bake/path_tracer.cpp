#include "precompute/bake/path_tracer.h"

#include "precompute/bake/sobol.h"
#include "protocol/basis/cubemap.h"

#include <algorithm>
#include <cmath>

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
                                    .row = morton_even(morton >> 1U),
                                    .column = morton_even(morton)});
}

Imath::V3f reflectance(const scene::Bsdf& bsdf) {
    if (bsdf.is_diffuse()) {
        return bsdf.diffuse_colour();
    }
    constexpr float kDarkest = 0.02F;  // a division that must not blow up
    const Imath::V3f sum = bsdf.diffuse_colour() + bsdf.specular_colour();
    return {std::max(sum.x, kDarkest), std::max(sum.y, kDarkest), std::max(sum.z, kDarkest)};
}

SurfacePaths PathTracer::trace(const PixelSurface& surface,
                               std::uint32_t surface_number,
                               std::uint32_t x,
                               std::uint32_t y) const {
    SurfacePaths paths;
    paths.paths = std::max(1U, static_cast<std::uint32_t>(
                                   std::lround(surface.share * static_cast<float>(samples_))));
    const std::uint64_t key = transport::mix_bits(seed_ + 1) + surface_number;
    const std::uint32_t first = morton_index(x, y) * samples_;
    for (std::uint32_t i = 0; i < paths.paths; ++i) {
        trace_path(surface, first + i, key, paths);
    }
    paths.nearness /= static_cast<float>(paths.paths);
    return paths;
}

void PathTracer::trace_path(const PixelSurface& surface,
                            std::uint32_t index,
                            std::uint64_t key,
                            SurfacePaths& paths) const {
    scene::SurfacePoint point = surface.point;
    Imath::V3f weight{1, 1, 1};
    for (std::uint32_t event = 0;; ++event) {
        const std::uint64_t dimension = transport::mix_bits(key) + 2 * std::uint64_t{event};
        const scene::SurfacePoint::Sample sample =
            point.sample(sobol_point(index, dimension + 1).x, sobol_point(index, dimension));
        if (sample.pdf <= 0 || largest(sample.weight) <= 0) {
            if (!(event == 0 && point.bsdf.is_diffuse() && sample.pdf > 0 &&
                  point.is_above_surface(sample.wi))) {
                return;
            }
        }
        weight *= event == 0 ? demodulated(point.bsdf, sample.weight) : sample.weight;
        const Imath::V3f origin = offset_origin(point);
        const auto hit = caster_.closest_hit(origin, sample.wi);
        ++paths.rays;
        if (!hit) {
            if (event > 0) {  // else it is direct light
                record(sample.wi, weight, paths);
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
            if (sobol_point(index, dimension + 1).y >= survive) {
                return;
            }
            weight /= survive;
        }
        point = scene::surface_point(caster_.scene(), hit->mesh, hit->triangle,
                                     hit->barycentric, sample.wi);
    }
}

void PathTracer::record(const Imath::V3f& direction,
                        const Imath::V3f& weight,
                        SurfacePaths& paths) const {
    const basis::Texel texel = basis::texel_from_direction(face_resolution_, direction);
    paths.escapes.push_back(
        {.texel = texel_key(face_resolution_, static_cast<std::uint32_t>(texel.face),
                            morton_index(texel.column, texel.row)),
         .weight = weight});
}

}  // namespace relume::bake
