#include "tests/stability/mesh/open_floor.h"

#include "precompute/scene/builtin/mesh_builder.h"
#include "protocol/basis/cubemap.h"
#include "protocol/brdf/local_frame.h"
#include "server/view/mesh/pinhole_from_look.h"
#include "server/view/mesh/pixel_rays.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace relume::stability {

scene::Scene open_floor(const scene::Material& material) {
    scene::Scene scene;
    scene.name = "open-floor";
    scene.materials.push_back(material);
    scene::MeshBuilder floor("floor", 0);
    floor.add_quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2});
    scene.meshes.push_back(floor.take());
    scene.camera = {.name = "above",
                    .eye = {0, 2, 2},
                    .look_at = {0, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 30};
    finish_scene(scene);
    return scene;
}

scene::Bsdf bsdf_of(const scene::Material& material) {
    return material.bsdf_at({}, {}, {1, 1, 1});
}

view::Look look_at_floor(double elevation_degrees, double fov_degrees, std::uint32_t side) {
    const double elevation = elevation_degrees * std::numbers::pi / 180;
    return {.eye = Imath::V3d(0, std::sin(elevation), std::cos(elevation)),
            .look_at = {0, 0, 0},
            .up = {0, 1, 0},
            .fov_degrees = fov_degrees,
            .width = side,
            .height = side};
}

Imath::V3d reflected(const scene::Bsdf& bsdf,
                     const Imath::V3f& to_viewer,
                     const light::LightCubemap& light) {
    constexpr std::uint32_t kSide = 4;
    const brdf::Frame frame = brdf::local_frame({0, 1, 0});
    const Imath::V3f wo = frame.local_from_world(to_viewer);
    const std::uint32_t n = light.face_resolution;
    Imath::V3d sum(0);
    for (std::size_t i = 0; i < light.plane_size(); ++i) {
        const Imath::V3d radiance(light.planes()[0][i], light.planes()[1][i],
                                  light.planes()[2][i]);
        if (radiance == Imath::V3d(0)) {
            continue;
        }
        const basis::Texel texel = basis::texel_from_index(n, i);
        const auto at = [](std::uint32_t place) {
            return (static_cast<float>(place) + 0.5F) / kSide;
        };
        for (std::uint32_t place = 0; place < kSide * kSide; ++place) {
            const Imath::V3f wi = frame.local_from_world(
                basis::direction_from_texel(n, texel, at(place % kSide), at(place / kSide)));
            if (wi.z > 0) {
                const double weight =
                    double{wi.z} * double{basis::solid_angle_sr(n, texel.row, texel.column)} /
                    (kSide * kSide);
                sum += radiance * Imath::V3d(bsdf.evaluate(wi, wo)) * weight;
            }
        }
    }
    return sum;
}

RelitImage reflected_image(const scene::Bsdf& bsdf,
                           const view::Look& look,
                           const light::LightCubemap& light) {
    const view::PixelRays rays(view::pinhole_from_look(look, {.origin = {0, 0, 0}, .unit = 1}),
                               look.width, look.height);
    RelitImage image{look.width, look.height, {}};
    image.rgb.resize(std::size_t{3} * look.width * look.height);
    tbb::parallel_for(std::uint32_t{0}, look.width * look.height, [&](std::uint32_t pixel) {
        const Imath::V3f ray =
            rays.direction(pixel % look.width + 0.5, pixel / look.width + 0.5).normalized();
        const Imath::V3d radiance = reflected(bsdf, -ray, light);
        for (int c = 0; c < 3; ++c) {
            image.rgb[3 * pixel + static_cast<std::size_t>(c)] =
                static_cast<float>(radiance[c]);
        }
    });
    return image;
}

}  // namespace relume::stability
