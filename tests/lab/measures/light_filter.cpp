#include "tests/lab/measures/light_filter.h"

#include "protocol/basis/cubemap.h"
#include "server/light/rotation_resample.h"
#include "tests/support/reference_tracer/tracer.h"

#include <Imath/ImathQuat.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace relume::lab {
namespace {

using Imath::V3d;
using Imath::V3f;
using Radiance = reference::Sky::Radiance;

Imath::Quatf random_rotation(std::mt19937_64& random) {
    std::normal_distribution<float> normal;
    return Imath::Quatf(normal(random), normal(random), normal(random), normal(random))
        .normalized();
}

Radiance turned_map(const light::EnvironmentMap& map, const Imath::Quatf& rotation) {
    return [&map, source_from_world = rotation.inverse()](const V3d& direction) {
        return V3d(map.radiance(source_from_world.rotateVector(V3f(direction))));
    };
}

Radiance of_texels(std::uint32_t n, std::vector<V3d> texels) {
    return [n, texels = std::move(texels)](const V3d& direction) {
        return texels[basis::index_from_texel(n,
                                              basis::texel_from_direction(n, V3f(direction)))];
    };
}

Radiance filtered(const light::PrefilteredEnvironment& environment,
                  const Imath::Quatf& rotation) {
    const std::uint32_t n = environment.face_resolution();
    light::LightCubemap cubemap(n);
    light::resample(environment, rotation, V3f(1), light::Write::overwrite, cubemap);
    const auto planes = cubemap.planes();
    std::vector<V3d> texels(cubemap.plane_size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = {planes[0][i], planes[1][i], planes[2][i]};
    }
    return of_texels(n, std::move(texels));
}

Radiance texel_means(std::uint32_t n, const Radiance& radiance) {
    // A side of the cube in 1024 parts: finer than the maps that are turned.
    constexpr std::uint32_t kPartsAlongFace = 1024;
    const std::uint32_t parts = kPartsAlongFace / n;
    std::vector<V3d> texels(basis::texel_count(n));
    tbb::parallel_for(std::size_t{0}, texels.size(), [&](std::size_t i) {
        V3d sum(0);
        double weight_sum = 0;
        for (std::uint32_t part = 0; part < parts * parts; ++part) {
            const basis::Texel texel = basis::texel_from_index(n, i);
            const double u = (texel.column + (part % parts + 0.5) / parts) * 2.0 / n - 1.0;
            const double v = (texel.row + (part / parts + 0.5) / parts) * 2.0 / n - 1.0;
            const V3d point(basis::cube_point_from_face_point(
                {texel.face, static_cast<float>(u), static_cast<float>(v)}));
            const double weight = std::pow(point.length2(), -1.5);
            sum += weight * radiance(point.normalized());
            weight_sum += weight;
        }
        texels[i] = sum / weight_sum;
    });
    return of_texels(n, std::move(texels));
}

// Σ over pixels and colours of the product of two images.
double product(const std::vector<V3d>& a, const std::vector<V3d>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += a[i].dot(b[i]);
    }
    return sum;
}

std::vector<V3d> difference(const std::vector<V3d>& a, const std::vector<V3d>& b) {
    std::vector<V3d> result(a.size());
    std::transform(a.begin(), a.end(), b.begin(), result.begin(),
                   [](const V3d& x, const V3d& y) { return x - y; });
    return result;
}

// Collects, over turns, two independent images of the difference of two lights.
class DistanceMeter {
  public:
    void add(const std::vector<V3d>& first, const std::vector<V3d>& second) {
        squared_ += product(first, second);
        const std::vector<V3d> noise = difference(first, second);
        // The product of two such noises of variance s² at N values has the deviation s²·√N.
        const double variance_sum = product(noise, noise) / 2;
        variance_of_squared_ +=
            variance_sum * variance_sum / (3.0 * static_cast<double>(noise.size()));
    }
    [[nodiscard]] LightFilterError::Distance relative_to(double size) const {
        return {.value = std::sqrt(std::max(0.0, squared_) / size),
                .least = std::sqrt(std::sqrt(variance_of_squared_) / size)};
    }

  private:
    double squared_ = 0;
    double variance_of_squared_ = 0;
};

}  // namespace

LightFilterError light_filter_error(const scene::Scene& scene,
                                    const light::PrefilteredEnvironment& environment,
                                    const LightFilterOptions& options) {
    const std::uint32_t n = environment.face_resolution();
    std::mt19937_64 random(options.seed);
    double size = 0;
    DistanceMeter filtered_distance;
    DistanceMeter means_distance;
    for (std::uint32_t turn = 0; turn < options.turns; ++turn) {
        const Imath::Quatf rotation = random_rotation(random);
        const Radiance map = turned_map(environment.source(), rotation);
        const Radiance of_filter = filtered(environment, rotation);
        const Radiance of_means = texel_means(n, map);
        // Where any of them is bright there are samples.
        const auto guide = reference::Sky::from_function(
            128, [&](const V3d& d) { return map(d) + of_filter(d) + of_means(d); });
        std::vector<V3d> images[2][3];
        for (std::uint64_t half = 0; half < 2; ++half) {
            const reference::TraceOptions trace{.width = options.image_side,
                                                .height = options.image_side,
                                                .samples = options.samples,
                                                .bounces = options.bounces,
                                                .seed = random()};
            for (std::size_t light = 0; light < 3; ++light) {
                const Radiance& radiance =
                    light == 0 ? map : (light == 1 ? of_filter : of_means);
                images[half][light] =
                    reference::trace(scene, guide.with_radiance(radiance), trace).mean;
            }
        }
        size += product(images[0][0], images[1][0]);
        filtered_distance.add(difference(images[0][1], images[0][0]),
                              difference(images[1][1], images[1][0]));
        means_distance.add(difference(images[0][2], images[0][0]),
                           difference(images[1][2], images[1][0]));
    }
    return {.filtered = filtered_distance.relative_to(size),
            .texel_means = means_distance.relative_to(size)};
}

}  // namespace relume::lab
