#include "tests/support/reference_tracer/tracer.h"

#include "precompute/scene/camera.h"
#include "tests/support/sample_moments.h"

#include <tbb/parallel_for.h>

#include <cstddef>

namespace relume::reference {
namespace {

using Imath::V3d;

// [Veach97 §9.2.4] with β = 2.
double power_heuristic(double mine, double other) {
    const double m2 = mine * mine;
    return m2 / (m2 + other * other);
}

// Follows a path; arrive(direction, weight) is told what of the sky reaches its start, over all
// scattering orders.
template <typename Arrive>
void follow_path(const Geometry& geometry,
                 const Sky& sky,
                 std::uint32_t bounces,
                 V3d origin,
                 V3d direction,
                 Random& random,
                 Arrive&& arrive) {
    V3d throughput(1, 1, 1);
    for (std::uint32_t vertex = 0; vertex <= bounces; ++vertex) {
        const auto surface = geometry.surface(origin, direction);
        if (!surface)
            break;
        const Reflection& reflection = surface->reflection;
        const V3d wo = -direction;
        const auto reflected = [&](const V3d& wi) {
            const double cosine = wi.dot(reflection.normal);
            const bool is_lit = cosine > 0 && wi.dot(surface->face_normal) > 0;
            return is_lit ? reflection.value(wi, wo) * cosine : V3d(0, 0, 0);
        };

        const SkySample light = sky.sampled(random);
        const V3d from_light = reflected(light.direction);
        if (from_light.length2() > 0 &&
            geometry.sees_sky(geometry.origin_beside(*surface, light.direction),
                              light.direction)) {
            const double weight =
                power_heuristic(light.density, reflection.density(light.direction, wo));
            arrive(light.direction, throughput * from_light * (weight / light.density));
        }

        const V3d wi = reflection.sampled(wo, random);
        const double density = reflection.density(wi, wo);
        const V3d onward = reflected(wi);
        if (density <= 0 || onward.length2() == 0)
            break;
        throughput *= onward / density;
        origin = geometry.origin_beside(*surface, wi);
        direction = wi;
        if (geometry.sees_sky(origin, direction)) {
            const double weight = power_heuristic(density, sky.density(direction));
            arrive(direction, throughput * weight);
            break;
        }
    }
}

// Calls pixel_paths(pixel, follow) for every pixel, in parallel; follow(arrive) follows one
// more of its paths.
template <typename PixelPaths>
void for_each_pixel(const scene::Scene& scene,
                    const Sky& sky,
                    const TraceOptions& options,
                    PixelPaths&& pixel_paths) {
    const Geometry geometry(scene);
    const scene::Camera camera(scene.camera, options.width, options.height);
    const std::size_t pixels = std::size_t{options.width} * options.height;
    tbb::parallel_for(std::size_t{0}, pixels, [&](std::size_t pixel) {
        Random random(options.seed * 0x100000001b3U + pixel * 0x9e3779b1U + 17);
        const auto x = static_cast<double>(pixel % options.width);
        const auto y = static_cast<double>(pixel / options.width);
        const bool is_box = options.filter == PixelFilter::box;
        pixel_paths(pixel, [&](auto&& arrive) {
            const double dx = is_box ? random.uniform() : 0.5;
            const double dy = is_box ? random.uniform() : 0.5;
            const Imath::V3f direction = camera.direction_from_pixel(
                static_cast<float>(x + dx), static_cast<float>(y + dy));
            follow_path(geometry, sky, options.bounces, V3d(camera.eye()),
                        V3d(direction).normalized(), random, arrive);
        });
    });
}

}  // namespace

TracedImage trace(const scene::Scene& scene, const Sky& sky, const TraceOptions& options) {
    const std::size_t pixels = std::size_t{options.width} * options.height;
    TracedImage image{options.width, options.height, std::vector<V3d>(pixels),
                      std::vector<V3d>(pixels)};
    for_each_pixel(scene, sky, options, [&](std::size_t pixel, auto&& follow) {
        test::SampleMoments<V3d> radiance(V3d(0, 0, 0));
        for (std::uint32_t i = 0; i < options.samples; ++i) {
            V3d value(0, 0, 0);
            follow([&](const V3d& direction, const V3d& weight) {
                value += weight * sky.radiance(direction);
            });
            radiance.add(value);
        }
        image.mean[pixel] = radiance.mean();
        image.variance[pixel] = radiance.variance_of_mean();
    });
    return image;
}

V3d incoming(const Geometry& geometry,
             const Sky& sky,
             std::uint32_t events,
             const V3d& origin,
             const V3d& direction,
             Random& random) {
    if (geometry.sees_sky(origin, direction)) {
        return sky.radiance(direction);
    }
    V3d radiance(0, 0, 0);
    if (events > 0) {
        follow_path(geometry, sky, events - 1, origin, direction, random,
                    [&](const V3d& from, const V3d& weight) {
                        radiance += weight * sky.radiance(from);
                    });
    }
    return radiance;
}

void trace_arrivals(
    const scene::Scene& scene,
    const Sky& guide,
    const TraceOptions& options,
    const std::function<void(std::size_t pixel, const V3d& direction, const V3d& weight)>&
        arrive) {
    for_each_pixel(scene, guide, options, [&](std::size_t pixel, auto&& follow) {
        for (std::uint32_t i = 0; i < options.samples; ++i) {
            follow([&](const V3d& direction, const V3d& weight) {
                arrive(pixel, direction, weight / static_cast<double>(options.samples));
            });
        }
    });
}

}  // namespace relume::reference
