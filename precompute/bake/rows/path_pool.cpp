#include "precompute/bake/rows/path_pool.h"

#include "precompute/scene/mirror_lobe.h"

#include <algorithm>
#include <cmath>
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
float similarity(const PixelSurface& own, float nearness, const PixelSurface& other) {
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

void PathPool::gather(std::uint32_t x,
                      std::uint32_t y,
                      std::uint32_t surface,
                      EscapeSum& escapes) const {
    const TracedPixel& centre = window_.pixel(x, y);
    if (radius_ == 0) {
        escapes.add(centre.paths[surface], 1);
        return;
    }
    const PixelSurface& own = centre.view.surfaces[surface];
    const float nearness = centre.paths[surface].nearness;
    const float falloff = 2.0F / squared(static_cast<float>(radius_));  // σ = radius/2
    const std::uint32_t left = std::max(x > radius_ ? x - radius_ : 0, window_.columns().left);
    const std::uint32_t right = std::min(x + radius_ + 1, window_.columns().right);
    const std::uint32_t top = std::max(y > radius_ ? y - radius_ : 0, window_.top());
    const std::uint32_t bottom = std::min(y + radius_ + 1, window_.bottom());
    struct Weighed {
        const SurfacePaths* paths;
        float weight;
    };
    thread_local std::vector<Weighed> pooled;
    pooled.clear();
    float total = 0;
    for (std::uint32_t row = top; row < bottom; ++row) {
        for (std::uint32_t column = left; column < right; ++column) {
            const TracedPixel& pixel = window_.pixel(column, row);
            const float dx = static_cast<float>(column) - static_cast<float>(x);
            const float dy = static_cast<float>(row) - static_cast<float>(y);
            const float near = std::exp(-falloff * (dx * dx + dy * dy));
            for (std::size_t i = 0; i < pixel.paths.size(); ++i) {
                // A share of a pixel has that share of its paths, and counts by them.
                const float weight = near * pixel.view.surfaces[i].share *
                                     similarity(own, nearness, pixel.view.surfaces[i]);
                if (weight >= kLeastWeight * own.share) {
                    pooled.push_back({.paths = &pixel.paths[i], .weight = weight});
                    total += weight;
                }
            }
        }
    }
    for (const Weighed& one : pooled) {
        escapes.add(*one.paths, one.weight / total);
    }
}

}  // namespace relume::bake
