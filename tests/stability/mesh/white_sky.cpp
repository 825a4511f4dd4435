#include "tests/stability/mesh/white_sky.h"

#include "precompute/scene/surface_point.h"
#include "protocol/brdf/local_frame.h"
#include "server/view/mesh/pinhole_from_look.h"
#include "server/view/mesh/pixel_rays.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace relume::stability {

double open_part(const bake::RayCaster& caster,
                 const Imath::V3f& origin,
                 const Imath::V3f& normal) {
    constexpr int kDirections = 256;
    const brdf::Frame frame = brdf::local_frame(normal);
    int open = 0;
    for (int i = 0; i < kDirections; ++i) {
        const double radius2 = (i + 0.5) / kDirections;
        const double phi = 2 * std::numbers::pi * 0.6180339887498949 * i;
        const Imath::V3f local(Imath::V3d(std::sqrt(radius2) * std::cos(phi),
                                          std::sqrt(radius2) * std::sin(phi),
                                          std::sqrt(1 - radius2)));
        open += caster.is_occluded(origin, frame.world_from_local(local)) ? 0 : 1;
    }
    return static_cast<double>(open) / kDirections;
}

RelitImage image_under_white_sky(const scene::Scene& scene, const view::Look& look) {
    const bake::RayCaster caster(scene);
    const view::Pinhole pinhole =
        view::pinhole_from_look(look, {.origin = {0, 0, 0}, .unit = 1});
    const view::PixelRays rays(pinhole, look.width, look.height);
    RelitImage image{look.width, look.height, {}};
    image.rgb.resize(std::size_t{3} * look.width * look.height);
    tbb::parallel_for(std::uint32_t{0}, look.width * look.height, [&](std::uint32_t pixel) {
        const Imath::V3f ray =
            rays.direction(pixel % look.width + 0.5, pixel / look.width + 0.5);
        const auto hit = caster.closest_hit(Imath::V3f(pinhole.eye), ray);
        if (!hit) {
            return;
        }
        const scene::SurfacePoint point =
            scene::surface_point(scene, hit->mesh, hit->triangle, hit->barycentric, ray);
        const double open =
            open_part(caster, bake::offset_origin(point), point.geometric_normal);
        const Imath::V3f& colour =
            scene.materials[scene.meshes[hit->mesh].material].base_colour;
        for (int c = 0; c < 3; ++c) {
            image.rgb[3 * pixel + static_cast<std::size_t>(c)] =
                static_cast<float>(open) * colour[c];
        }
    });
    return image;
}

}  // namespace relume::stability
