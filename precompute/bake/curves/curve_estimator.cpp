#include "precompute/bake/curves/curve_estimator.h"

#include "precompute/bake/curves/point_brdf.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace relume::bake {
namespace {

brdf::DiffuseLobe diffuse_lobe(const scene::SurfacePoint& point,
                               const EditedMaterial& material) {
    if (material.albedo) {
        return {.colour = *material.albedo, .coat = {}};
    }
    const scene::Bsdf& bsdf = point.bsdf;
    brdf::DiffuseLobe lobe{.colour = bsdf.diffuse_colour(), .coat = {}};
    if (bsdf.model() == scene::BsdfModel::ggx) {
        lobe.coat = bsdf.coat();
    }
    return lobe;
}

sampling::CurvePoint curve_point(const scene::SurfacePoint& point,
                                 const EditedMaterial& material) {
    return {.shading = {point.shading.tangent, point.shading.bitangent, point.shading.normal},
            .geometric_normal = point.geometric_normal,
            .wo = point.wo,
            .diffuse = diffuse_lobe(point, material)};
}

}  // namespace

void CurveEstimator::estimate(const ReceiverSurface& surface,
                              const SequencePlace& place,
                              const EditedMaterial& material,
                              CurveShares& shares,
                              std::uint64_t& rays) const {
    shares = {};
    const std::size_t points = std::max<std::size_t>(surface.turns.size(), 1);
    const auto point_of = [&](std::size_t i) -> const scene::SurfacePoint& {
        return surface.turns.empty() ? surface.point : surface.turns[i];
    };
    std::vector<PointBrdf> brdfs;
    brdfs.reserve(points);
    for (std::size_t i = 0; i < points; ++i) {
        brdfs.emplace_back(material, point_of(i).bsdf);
    }
    std::array<std::uint32_t, sampling::kWays.size()> counts{};
    for (std::size_t way = 0; way < counts.size(); ++way) {
        // As many from each of the points, so that all of them count alike.
        const auto each = static_cast<std::uint32_t>(std::lround(
            surface.share * static_cast<float>(samples_ * sampling::kDirectionsOfWay[way]) /
            static_cast<float>(points)));
        counts[way] = std::max(each, 1U) * static_cast<std::uint32_t>(points);
    }
    const std::uint64_t surface_key = transport::mix_bits(seed_ + 5) + surface.number;
    for (const sampling::Way way : sampling::kWays) {
        const auto number = static_cast<std::size_t>(way);
        const std::uint64_t key = transport::mix_bits(surface_key) + 16 * std::uint64_t{number};
        const std::uint32_t first = place.run * samples_ * sampling::kDirectionsOfWay[number];
        for (std::uint32_t i = 0; i < counts[number]; ++i) {
            const scene::SurfacePoint& point = point_of(i % points);
            const Imath::V3f origin =
                surface.turns.empty() ? surface.origins[i % kPacketSize] : offset_origin(point);
            const sampling::CurvePoint lit = curve_point(point, material);
            const sampling::CurveOfBrdf edited = brdfs[i % points].edited();
            sampling::CurveSampler sampler(lit, edited, radiance_.light(), counts);
            if (sampler.draw(way, first + i, key) && sampler.reflects()) {
                sampler.add(radiance_.incoming(origin, sampler.direction(),
                                               {.index = first + i, .key = key + 2}, rays),
                            shares);
            }
        }
    }
}

}  // namespace relume::bake
