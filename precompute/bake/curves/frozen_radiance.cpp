#include "precompute/bake/curves/frozen_radiance.h"

#include "precompute/scene/surface_point.h"
#include "protocol/sampling/sobol.h"
#include "protocol/transport/hash.h"

#include <algorithm>
#include <optional>

namespace relume::bake {
namespace {

// From this scattering event on, dark paths may end early.
constexpr std::uint32_t kFirstRoulette = 4;
constexpr float kMostSurvive = 0.95F;

float largest(const Imath::V3f& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

Imath::V3f FrozenRadiance::incoming(const Imath::V3f& origin,
                                    const Imath::V3f& direction,
                                    const PathNumbers& numbers,
                                    std::uint64_t& rays) const {
    ++rays;
    std::optional<Hit> hit = caster_.closest_hit(origin, direction);
    if (!hit) {
        return light_.radiance(direction);
    }
    Imath::V3f radiance{0, 0, 0};
    Imath::V3f weight{1, 1, 1};
    Imath::V3f along = direction;
    for (std::uint32_t event = 1; event <= bounces_; ++event) {
        const scene::SurfacePoint point = scene::surface_point(
            caster_.scene(), hit->mesh, hit->triangle, hit->barycentric, along);
        const Imath::V3f start = offset_origin(point);
        const std::uint64_t dimension = transport::mix_bits(numbers.key) + 4 * event;
        const Imath::V2f more = sampling::sobol_point(numbers.index, dimension + 1);

        const sampling::TexelLight::Sample bright =
            light_.sample(more.x, sampling::sobol_point(numbers.index, dimension));
        if (bright.pdf > 0) {
            const Imath::V3f reflected = point.reflect(bright.direction);
            if (largest(reflected) > 0) {
                ++rays;
                if (!caster_.is_occluded(start, bright.direction)) {
                    radiance += weight * reflected * light_.radiance(bright.direction) /
                                (bright.pdf + point.pdf(bright.direction));
                }
            }
        }

        const scene::SurfacePoint::Sample sample =
            point.sample(more.y, sampling::sobol_point(numbers.index, dimension + 2));
        if (sample.pdf <= 0 || largest(sample.weight) <= 0) {
            break;
        }
        weight *= sample.weight;
        ++rays;
        hit = caster_.closest_hit(start, sample.wi);
        if (!hit) {
            radiance += weight * light_.radiance(sample.wi) *
                        (sample.pdf / (sample.pdf + light_.pdf(sample.wi)));
            break;
        }
        if (event >= kFirstRoulette) {
            const float survive = std::min(largest(weight), kMostSurvive);
            if (sampling::sobol_point(numbers.index, dimension + 3).x >= survive) {
                break;
            }
            weight /= survive;
        }
        along = sample.wi;
    }
    return radiance;
}

}  // namespace relume::bake
