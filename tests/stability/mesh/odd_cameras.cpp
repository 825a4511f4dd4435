// Cameras that stand in a block, on a wall, at a vertex, behind everything; that see next to
// nothing or nearly all.
#include "precompute/scene/builtin/mesh_builder.h"
#include "server/view/mesh/pinhole_from_look.h"
#include "server/view/mesh/visible_surface.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 64;
constexpr std::array<double, 5> kFieldsOfView{0.01, 1, 60, 120, 179};

// A block on a floor, in front of a wall.
scene::Scene yard() {
    scene::Scene scene;
    scene.name = "yard";
    scene.materials.push_back({.name = "floor", .base_colour = {0.7F, 0.7F, 0.6F}});
    scene.materials.push_back({.name = "block",
                               .model = scene::BsdfModel::phong,
                               .base_colour = {0.5F, 0.2F, 0.1F},
                               .specular = Imath::V3f(0.3F),
                               .exponent = 20});
    scene::MeshBuilder floor("floor", 0);
    floor.add_quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3});
    floor.add_quad({-3, 0, -3}, {3, 0, -3}, {3, 3, -3}, {-3, 3, -3});
    scene::MeshBuilder block("block", 1);
    block.add_box({0, 0.5F, 0}, {1, 1, 1});
    scene.meshes.push_back(floor.take());
    scene.meshes.push_back(block.take());
    scene.camera = {.name = "front",
                    .eye = {2, 2, 4},
                    .look_at = {0, 0.5F, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 40};
    finish_scene(scene);
    return scene;
}

struct OddPlace {
    const char* name;
    Imath::V3d eye;
    Imath::V3d look_at;
};

constexpr std::array<OddPlace, 9> kPlaces{{
    {"inside the block", {0.1, 0.6, 0.05}, {2, 0.3, 3}},
    {"inside, near a corner", {0.499, 0.999, 0.499}, {-1, -1, -1}},
    {"on a side of the block", {0.5, 0.4, 0.1}, {0, 0.4, 0}},
    {"at a vertex", {0.5, 1, 0.5}, {0, 0, 0}},
    {"on the floor", {1, 0, 1}, {0, 0.5, 0}},
    {"below the floor", {0.4, -1, 0.3}, {0, 2, 0}},
    {"behind everything", {0, 1, 20}, {0, 1, 40}},
    {"straight up", {0, 3, 0}, {0, 9, 0}},
    {"where it looks at", {1, 1, 1}, {1, 1, 1}},
}};

view::Look look_from(const OddPlace& place, double fov_degrees) {
    return {.eye = place.eye,
            .look_at = place.look_at,
            .up = {0, 1, 0},
            .fov_degrees = fov_degrees,
            .width = kSide,
            .height = kSide};
}

double count_not_finite(const RelitImage& image) {
    return static_cast<double>(std::count_if(
        image.rgb.begin(), image.rgb.end(), [](float value) { return !std::isfinite(value); }));
}

struct Seen {
    double something = 0;    // pixels that show a surface
    double block = 0;        // … of the block
    double passing_eye = 0;  // triangles with corners before and behind the eye
};

Seen look_at(const transport::SurfaceMesh& mesh, const view::Look& look) {
    const view::Pinhole pinhole =
        view::pinhole_from_look(look, {.origin = {0, 0, 0}, .unit = 1});
    view::VisibleSurface visible;
    visible.look(mesh, pinhole, kSide, kSide);
    Seen seen;
    for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
        const std::uint32_t triangle = visible.point(pixel % kSide, pixel / kSide).triangle;
        if (triangle != view::kNoTriangle) {
            ++seen.something;
            seen.block += mesh.triangles[triangle].material == 1 ? 1 : 0;
        }
    }
    for (const transport::SurfaceTriangle& triangle : mesh.triangles) {
        int before = 0;
        for (const std::uint32_t vertex : triangle.vertices) {
            const Imath::V3d from_eye = Imath::V3d(mesh.positions[vertex]) - pinhole.eye;
            before += from_eye.dot(pinhole.forward) > 0 ? 1 : 0;
        }
        seen.passing_eye += before == 1 || before == 2 ? 1 : 0;
    }
    return seen;
}

Outcome provoke(Workbench& workbench) {
    bake::BakeParameters parameters = surface_parameters(1500);
    parameters.terms = 3;
    const BakedSurface surface(yard(), parameters);
    workbench.progress("odd_cameras", 0.6);
    const std::vector<float> sums =
        surface.exact_sums(sky_and_disc(surface.scene()->face_resolution(), 0.4F,
                                        {.direction = direction_from_degrees(140, 50),
                                         .angular_radius_radians = radians_from_degrees(8),
                                         .radiance = Imath::V3f(20)}));
    const transport::SurfaceMesh& mesh = surface.transport().surface()->mesh;

    double passing_eye = 0;
    double not_finite = 0;
    double block_from_inside = 0;
    double seen_from_inside = 0;
    double behind_everything = 0;
    Outcome outcome;
    for (const OddPlace& place : kPlaces) {
        for (const double fov : kFieldsOfView) {
            const view::Look look = look_from(place, fov);
            const RelitImage image = surface.image_of_sums(look, sums);
            const Seen seen = look_at(mesh, look);
            not_finite += count_not_finite(image);
            passing_eye += seen.passing_eye;
            const std::string_view name = place.name;
            if (name.starts_with("inside")) {
                block_from_inside += seen.block;
                seen_from_inside += seen.something;
            }
            if (name == "behind everything") {
                behind_everything += seen.something;
                behind_everything +=
                    static_cast<double>(std::count_if(image.rgb.begin(), image.rgb.end(),
                                                      [](float value) { return value != 0; }));
            }
        }
    }
    outcome.findings = {
        {"triangles with corners before and behind the eye", Sense::at_least, 1000, passing_eye,
         "a projection that divides by depth turns these inside out"},
        {"image values not finite", Sense::at_most, 0, not_finite,
         "edge functions are homogeneous: nothing is divided by a depth of zero"},
        {"from inside the block: pixels that show the block", Sense::at_most, 0,
         block_from_inside, "a solid has an outside alone, so who stands in it sees out of it"},
        {"from inside the block: pixels that show what is around it", Sense::at_least, 1000,
         seen_from_inside, "floor and wall are open, and have two sides"},
        {"behind everything: pixels and image values that are not empty", Sense::at_most, 0,
         behind_everything, "what lies behind the eye is not seen"},
    };
    for (const auto& [place, fov] :
         {std::pair{std::size_t{0}, 60.0}, {2, 120.0}, {3, 120.0}, {5, 60.0}}) {
        outcome.tiles.push_back({surface.image_of_sums(look_from(kPlaces[place], fov), sums),
                                 fmt::format("{}, {} degrees", kPlaces[place].name, fov)});
    }
    return outcome;
}

}  // namespace

Failure odd_cameras() {
    return {
        .name = "odd_cameras",
        .what = "cameras inside things, at vertices and with extreme lenses break the image",
        .scene =
            "a block on a floor before a wall, seen from nine odd places with 0.01 to "
            "179 degrees, 64x64, n = 16, K = 3",
        .provoke = provoke};
}

}  // namespace relume::stability
