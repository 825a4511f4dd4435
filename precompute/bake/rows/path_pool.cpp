#include "precompute/bake/rows/path_pool.h"

#include "precompute/scene/mirror_lobe.h"
#include "protocol/brdf/local_frame.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace relume::bake {
namespace {

// Weights below this are not worth their time.
constexpr float kLeastWeight = 0.01F;

float glossy_width(const scene::Bsdf& bsdf) {
    return bsdf.model() == scene::BsdfModel::ggx ? 2.0F * bsdf.alpha()
                                                 : std::sqrt(2.0F / (bsdf.exponent() + 2.0F));
}

float squared(float x) {
    return x * x;
}

// In [0, 1]; 0 where the neighbour's paths say nothing about the surface.
float similarity(const ReceiverSurface& own, float nearness, const ReceiverSurface& other) {
    if (own.material != other.material) {
        return 0;
    }
    constexpr float kPlaneFootprints = 2.0F;
    constexpr float kNormalWidth = 0.2F;    // radians
    constexpr float kNearnessWidth = 0.1F;  // of the harmonic mean distance
    const Imath::V3f between = other.point.position - own.point.position;
    const float off_plane =
        between.dot(own.point.geometric_normal) / (kPlaneFootprints * own.footprint);
    const float turned =
        (own.point.shading.normal - other.point.shading.normal).length() / kNormalWidth;
    const float along = between.length() * nearness / kNearnessWidth;
    float exponent = squared(off_plane) + squared(turned) + squared(along);
    if (!own.point.bsdf.is_diffuse()) {
        const float apart =
            (scene::mirror_direction(own.point) - scene::mirror_direction(other.point))
                .length();
        exponent += squared(apart / glossy_width(own.point.bsdf));
    }
    return std::exp(-0.5F * exponent);
}

}  // namespace

void add_paths(const ReceiverSurface& own,
               const SurfacePaths& paths,
               float weight,
               std::span<EscapeSum> escapes) {
    if (own.brdf == nullptr) {
        escapes.front().add(paths, weight);
        return;
    }
    thread_local std::vector<float> g;
    thread_local std::vector<float> factors;
    const std::size_t terms = own.brdf->terms;
    const brdf::Frame frame = brdf::local_frame(own.point.shading.normal);
    g.resize(paths.starts.size() * terms);
    for (std::size_t i = 0; i < paths.starts.size(); ++i) {
        own.brdf->g.evaluate(frame.local_from_world(paths.starts[i].direction),
                             std::span(g).subspan(i * terms, terms));
    }
    factors.resize(paths.starts.size());
    for (std::size_t k = 0; k < terms; ++k) {
        for (std::size_t i = 0; i < factors.size(); ++i) {
            factors[i] = std::numbers::pi_v<float> * g[i * terms + k];
        }
        escapes[k].add(paths, weight, factors);
    }
}

void PathPool::gather(std::size_t receiver,
                      std::uint32_t surface,
                      std::span<EscapeSum> escapes) const {
    const TracedReceiver& centre = traced_.at(receiver);
    const std::uint32_t radius = traced_.radius();
    const ReceiverSurface& own = centre.receiver.surfaces[surface];
    if (radius == 0) {
        add_paths(own, centre.paths[surface], 1, escapes);
        return;
    }
    const float nearness = centre.paths[surface].nearness;
    const float falloff = 2.0F / squared(static_cast<float>(radius));  // σ = radius/2
    struct Weighed {
        const SurfacePaths* paths;
        float weight;
    };
    thread_local std::vector<Neighbour> neighbours;
    thread_local std::vector<Weighed> pooled;
    traced_.receivers().find_neighbours(receiver, radius, neighbours);
    pooled.clear();
    float total = 0;
    for (const Neighbour& neighbour : neighbours) {
        const TracedReceiver& other = traced_.at(neighbour.receiver);
        const float near = std::exp(-falloff * neighbour.squared_distance);
        for (std::size_t i = 0; i < other.paths.size(); ++i) {
            // A share of a receiver has that share of its paths, and counts by them.
            const ReceiverSurface& theirs = other.receiver.surfaces[i];
            const float weight = near * theirs.share * similarity(own, nearness, theirs);
            if (weight >= kLeastWeight * own.share) {
                pooled.push_back({.paths = &other.paths[i], .weight = weight});
                total += weight;
            }
        }
    }
    for (const Weighed& one : pooled) {
        add_paths(own, *one.paths, one.weight / total, escapes);
    }
}

}  // namespace relume::bake
