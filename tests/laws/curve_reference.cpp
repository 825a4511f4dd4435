#include "tests/laws/curve_reference.h"

#include "precompute/bake/rays/ray_caster.h"
#include "precompute/scene/camera.h"
#include "precompute/scene/surface_point.h"
#include "tests/support/reference_tracer/geometry.h"
#include "tests/support/reference_tracer/random.h"
#include "tests/support/sample_moments.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <vector>

namespace relume::test {
namespace {

using Imath::V3d;

// f in 1/sr of a surface whose specular part is `brdf`; null: the scene's own.
V3d reflected(const reference::Reflection& reflection,
              const curve::CurveBrdf* brdf,
              const V3d& wi,
              const V3d& wo) {
    if (brdf == nullptr) {
        return reflection.value(wi, wo);
    }
    reference::Reflection diffuse = reflection;
    diffuse.specular = V3d(0, 0, 0);
    diffuse.grazing = 0;
    const scene::Frame frame = scene::Frame::from_normal(Imath::V3f(reflection.normal));
    return diffuse.value(wi, wo) +
           V3d(brdf->evaluate(frame.to_local(Imath::V3f(wi)), frame.to_local(Imath::V3f(wo))));
}

}  // namespace

reference::TracedImage reflect_with_curves(
    const scene::Scene& scene,
    const reference::Sky& sky,
    const std::map<std::uint32_t, curve::CurveBrdf>& edited,
    const CurveReference& options) {
    const std::uint32_t side = options.side;
    const reference::Geometry geometry(scene);
    const scene::Camera camera(scene.camera, side, side);
    const bake::RayCaster caster(scene);  // says which material a pixel shows
    const std::vector<V3d> black(std::size_t{side} * side, V3d(0, 0, 0));
    reference::TracedImage image{side, side, black, black};
    tbb::parallel_for(std::size_t{0}, image.mean.size(), [&](std::size_t pixel) {
        reference::Random random(pixel * 0x9e3779b1U + options.seed);
        const Imath::V3f along = camera.direction_from_pixel(
            static_cast<float>(pixel % side) + 0.5F, static_cast<float>(pixel / side) + 0.5F);
        const V3d direction = V3d(along).normalized();
        const auto surface = geometry.surface(V3d(camera.eye()), direction);
        const auto hit = caster.closest_hit(camera.eye(), along);
        if (!surface || !hit) {
            return;
        }
        const auto found = edited.find(scene.meshes[hit->mesh].material);
        const curve::CurveBrdf* brdf = found == edited.end() ? nullptr : &found->second;
        const reference::Reflection& reflection = surface->reflection;
        const V3d wo = -direction;
        SampleMoments<V3d> moments(V3d(0, 0, 0));
        for (std::uint32_t i = 0; i < options.samples; ++i) {
            const V3d wi = random.uniform() < 0.5 ? sky.sampled(random).direction
                                                  : reflection.sampled(wo, random);
            const double cosine = wi.dot(reflection.normal);
            V3d value(0, 0, 0);
            if (cosine > 0 && wi.dot(surface->face_normal) > 0) {
                const double density = 0.5 * sky.density(wi) + 0.5 * reflection.density(wi, wo);
                value = reflected(reflection, brdf, wi, wo) *
                        reference::incoming(geometry, sky, options.bounces,
                                            geometry.origin_beside(*surface, wi), wi, random) *
                        (cosine / density);
            }
            moments.add(value);
        }
        image.mean[pixel] = moments.mean();
        image.variance[pixel] = moments.variance_of_mean();
    });
    return image;
}

}  // namespace relume::test
