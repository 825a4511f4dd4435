// Light that comes through walls: at a vertex in a corner, and within a triangle that passes
// under a wall.
#include "precompute/bake/probes/light_probe.h"
#include "precompute/bake/receivers/vertex/refinement.h"
#include "precompute/bake/receivers/vertex/vertex_receivers.h"
#include "precompute/scene/builtin/mesh_builder.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/white_sky.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 64;

// Six sheets that meet at their edges, turned, so that corners are rounded.
scene::Scene closed_room() {
    scene::Scene scene;
    scene.name = "closed-room";
    scene.materials.push_back({.name = "white", .base_colour = Imath::V3f(0.8F)});
    scene::MeshBuilder room("room", 0);
    room.place(scene::placed({0.3F, 0.1F, -0.2F}, 33));
    room.add_quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1});
    room.add_quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1});
    room.add_quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
    room.add_quad({1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1});
    room.add_quad({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1});
    room.add_quad({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1});
    scene.meshes.push_back(room.take());
    scene.camera = {.name = "inside",
                    .eye = {0.3F, 0.1F, 0.4F},
                    .look_at = {0.9F, -0.9F, -0.8F},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 80};
    finish_scene(scene);
    return scene;
}

// A hut without a door on a wide floor of two triangles.
scene::Scene hut_on_floor() {
    scene::Scene scene;
    scene.name = "hut";
    scene.materials.push_back({.name = "white", .base_colour = Imath::V3f(0.8F)});
    scene::MeshBuilder floor("floor", 0);
    floor.add_quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5});
    scene::MeshBuilder hut("hut", 0);
    hut.place(scene::placed({0.2F, 0, 0.3F}, 20));
    hut.add_box({0, 0.75F, 0}, {2, 1.5F, 2});
    scene.meshes.push_back(floor.take());
    scene.meshes.push_back(hut.take());
    scene.camera = {.name = "outside",
                    .eye = {4, 5, 7},
                    .look_at = {0, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 50};
    finish_scene(scene);
    return scene;
}

double mean_of(const RelitImage& image) {
    return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) /
           static_cast<double>(image.rgb.size());
}

// What the vertices inside the closed room get of the sky outside, rays leaving them where
// `origins` has them.
template <typename OriginsOf>
double light_in(const scene::Scene& scene, const OriginsOf& origins_of) {
    const bake::RayCaster caster(scene);
    const brdf::FactoredBrdf white = brdf::factored_lambert("white", Imath::V3f(0.8F));
    const std::vector<const brdf::FactoredBrdf*> brdfs{&white};
    const bake::RefinedSurface surface = bake::refine_surface(
        scene, bake::LightProbe(caster, brdfs, {}), {.most_vertices = 100, .target_error = 0});
    const bake::VertexReceivers vertices(scene, surface, brdfs);
    double sum = 0;
    std::size_t rays = 0;
    for (std::size_t vertex = 0; vertex < surface.vertex_count(); ++vertex) {
        const bake::ReceiverSurface at = vertices.look(vertex).surfaces.at(0);
        const Imath::V3f inwards = scene.camera.eye - at.point.position;
        if (inwards.dot(at.point.geometric_normal) < 0) {
            continue;  // of the outer side
        }
        for (const Imath::V3f& origin : origins_of(at)) {
            sum += open_part(caster, origin, at.point.geometric_normal);
            ++rays;
        }
    }
    return sum / static_cast<double>(rays);
}

// What to do without places: all rays leave from the vertex itself.
std::vector<Imath::V3f> at_vertex(const bake::ReceiverSurface& surface) {
    return {bake::offset_origin(surface.point)};
}

std::vector<Imath::V3f> as_baked(const bake::ReceiverSurface& surface) {
    return {surface.origins.begin(), surface.origins.end()};
}

Outcome provoke(Workbench& workbench) {
    const scene::Scene room = closed_room();
    const double from_vertices = light_in(room, at_vertex);
    const double from_places = light_in(room, as_baked);
    const BakedSurface baked_room(room, surface_parameters(500));
    const std::uint32_t n = baked_room.scene()->face_resolution();
    const Lighting sky = lighting_from_cubemap(constant_sky(n, 1));
    const RelitImage dark = baked_room.image(baked_room.scene()->beginning(), sky);
    workbench.progress("shadow_leaks", 0.4);

    const scene::Scene hut = hut_on_floor();
    const view::Look inside{.eye = {0.2, 1.2, 0.3},
                            .look_at = {0.2, 0, 0.3},
                            .up = {-0.342, 0, -0.94},  // along the hut's walls
                            .fov_degrees = 79,
                            .width = kSide,
                            .height = kSide};
    constexpr std::uint32_t kCoarse = 60;
    const std::uint32_t fine = workbench.choose(2000U, 40000U);
    const BakedSurface coarse_hut(hut, surface_parameters(kCoarse));
    bake::BakeParameters parameters = surface_parameters(fine);
    parameters.target_error = 1e-3;
    const BakedSurface fine_hut(hut, parameters);
    const RelitImage coarse_floor = coarse_hut.image(inside, sky);
    const RelitImage fine_floor = fine_hut.image(inside, sky);

    Outcome outcome;
    outcome.findings = {
        {"closed room, rays from vertices themselves: sky that they see", Sense::at_least, 1e-3,
         from_vertices, "in a corner a ray begins in all walls at once, and passes them"},
        {"rays as baked: the same", Sense::at_most, 0, from_places,
         "they begin a little inside the triangles around the vertex"},
        {"as baked: brightest value of the image from inside", Sense::at_most, 1e-3,
         double{*std::max_element(dark.rgb.begin(), dark.rgb.end())},
         "inner and outer sides share blocks; a thousandth is for storing them"},
        {fmt::format("closed hut on a floor, {} vertices: mean light on the floor inside",
                     kCoarse),
         Sense::at_least, 0.02, mean_of(coarse_floor),
         "a triangle that passes under the wall takes light in from outside"},
        {fmt::format("{} vertices: the same", fine), Sense::at_most,
         0.25 * mean_of(coarse_floor), mean_of(fine_floor),
         "triangles at the wall are cut first: those that pass under it are a strip along it"},
    };
    view::Look outside = fine_hut.scene()->beginning();
    outside.width = outside.height = 96;
    outcome.tiles = {{coarse_hut.image(outside, sky), fmt::format("hut, {} vertices", kCoarse)},
                     {coarse_floor, "the floor inside", 2},
                     {fine_hut.image(outside, sky), fmt::format("hut, {} vertices", fine)},
                     {fine_floor, "the floor inside", 2}};
    return outcome;
}

}  // namespace

Failure shadow_leaks() {
    return {.name = "shadow_leaks",
            .what = "light comes through walls between vertices",
            .scene =
                "a closed room from inside, and a closed hut on a floor, under a white "
                "sky, n = 16",
            .provoke = provoke};
}

}  // namespace relume::stability
