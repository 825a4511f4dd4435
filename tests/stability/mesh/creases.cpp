// A crate of which the sun sees two sides, and a dark tile beside a bright one: light and
// colour that are interpolated across the edge.
#include "precompute/scene/builtin/mesh_builder.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 96;

scene::Scene scene_of(scene::Mesh mesh) {
    scene::Scene scene;
    scene.name = "crate";
    scene.materials.push_back({.name = "white", .base_colour = Imath::V3f(0.8F)});
    scene.materials.push_back({.name = "black", .base_colour = Imath::V3f(0)});
    scene.meshes.push_back(std::move(mesh));
    scene.camera = {.name = "front",
                    .eye = {0, 1.5F, 4},
                    .look_at = {0, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 25};
    finish_scene(scene);
    return scene;
}

scene::Mesh crate() {
    scene::MeshBuilder builder("crate", 0);
    builder.add_box({0, 0, 0}, {1, 1, 1});
    return builder.take();
}

// As somebody smooths it who knows no creases: a normal at a corner is the mean of its sides'.
scene::Mesh smoothed(scene::Mesh mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.normals[i] = mesh.positions[i].normalized();
    }
    return mesh;
}

// A black tile to the left of a white one.
scene::Scene tiles() {
    scene::MeshBuilder black("black", 1);
    black.add_quad({-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0});
    scene::Scene scene = scene_of(black.take());
    scene::MeshBuilder white("white", 0);
    white.add_quad({0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0});
    scene.meshes.push_back(white.take());
    finish_scene(scene);
    return scene;
}

// Of the pixels of a rectangle, as parts of the image.
double brightest(const RelitImage& image, double left, double right) {
    double most = 0;
    for (std::uint32_t y = image.height * 2 / 5; y < image.height * 4 / 5; ++y) {
        const auto from = static_cast<std::uint32_t>(left * image.width);
        const auto to = static_cast<std::uint32_t>(right * image.width);
        for (std::uint32_t x = from; x < to; ++x) {
            most = std::max(most, double{image.rgb[3 * (std::size_t{y} * image.width + x)]});
        }
    }
    return most;
}

Outcome provoke(Workbench& workbench) {
    // From above and behind: the crate's front is dark.
    const auto sun = [](std::uint32_t n) {
        light::LightCubemap light = constant_sky(n, 0);
        light::add_area_light({.direction = direction_from_degrees(20, 65),
                               .angular_radius_radians = radians_from_degrees(5),
                               .radiance = Imath::V3f(60)},
                              light);
        return lighting_from_cubemap(light);
    };
    const BakedSurface kept(scene_of(crate()), surface_parameters(600));
    // As few as show what corners do: refinement would cut it away.
    const BakedSurface smooth(scene_of(smoothed(crate())), surface_parameters(40));
    workbench.progress("creases", 0.6);
    const BakedSurface border(tiles(), surface_parameters(600));
    const std::uint32_t n = kept.scene()->face_resolution();
    view::Look look = kept.scene()->beginning();
    look.width = look.height = kSide;
    const RelitImage kept_image = kept.image(look, sun(n));
    const RelitImage smooth_image = smooth.image(look, sun(n));
    const RelitImage border_image =
        border.image(look, lighting_from_cubemap(constant_sky(n, 1)));
    const double lit = double{*std::max_element(kept_image.rgb.begin(), kept_image.rgb.end())};
    Outcome outcome;
    outcome.findings = {
        {"smoothed normals, 40 vertices: brightest of the dark front, over the lit top",
         Sense::at_least, 0.02, brightest(smooth_image, 0.3, 0.7) / lit,
         "its corners are those of the top, and take its light"},
        {"normals as they are, 600 vertices: the same", Sense::at_most, 0.01,
         brightest(kept_image, 0.3, 0.7) / lit,
         "a corner is a vertex for each side of it; a hundredth is for storing"},
        {"black tile beside a white one: brightest", Sense::at_most, 0,
         brightest(border_image, 0.1, 0.49), "a border of materials has vertices for each"},
    };
    const float exposure = exposure_for(kept_image);
    outcome.tiles = {{kept_image, "normals as they are", exposure},
                     {smooth_image, "smoothed normals", exposure},
                     {border_image, "black and white tile"}};
    return outcome;
}

}  // namespace

Failure creases() {
    return {.name = "creases",
            .what = "light and colour are interpolated across creases and borders",
            .scene = "a crate whose front is in its own shadow, and two tiles, 96x96, n = 16",
            .provoke = provoke};
}

}  // namespace relume::stability
