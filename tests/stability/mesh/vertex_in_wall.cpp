// A floor with vertices inside the block that stands on it: their darkness comes out.
#include "precompute/scene/builtin/mesh_builder.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/mesh/white_sky.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 96;

// The floor has a vertex every metre, four of which are inside the block.
scene::Scene block_on_floor() {
    scene::Scene scene;
    scene.name = "block";
    scene.materials.push_back({.name = "white", .base_colour = Imath::V3f(0.8F)});
    scene::MeshBuilder floor("floor", 0);
    constexpr std::uint32_t kPoints = 8;
    floor.add_grid(kPoints, kPoints, scene::Closing::open, scene::Closing::open,
                   [](std::uint32_t i, std::uint32_t j) {
                       return Imath::V3f(static_cast<float>(j) - 3.5F, 0,
                                         3.5F - static_cast<float>(i));
                   });
    scene::MeshBuilder block("block", 0);
    block.place(scene::placed({0, 0, 0}, 12));
    block.add_box({0, 0.6F, 0}, {1.5F, 1.2F, 1.5F});
    scene.meshes.push_back(floor.take());
    scene.meshes.push_back(block.take());
    scene.camera = {.name = "above",
                    .eye = {1, 6, 3},
                    .look_at = {0, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 50};
    finish_scene(scene);
    return scene;
}

// How much too dark, on average where an image is too dark at all: of the truth.
double darkness(const RelitImage& image, const RelitImage& truth) {
    double missing = 0;
    double whole = 0;
    for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
        missing += std::max(0.0, double{truth.rgb[i]} - double{image.rgb[i]});
        whole += double{truth.rgb[i]};
    }
    return missing / whole;
}

Outcome provoke(Workbench& workbench) {
    const scene::Scene scene = block_on_floor();
    const std::uint32_t coarse_vertices = 160;  // hardly more than the scene has
    const std::uint32_t fine_vertices = workbench.choose(2000U, 40000U);
    const BakedSurface coarse(scene, surface_parameters(coarse_vertices));
    bake::BakeParameters parameters = surface_parameters(fine_vertices);
    parameters.target_error = 1e-3;
    const BakedSurface fine(scene, parameters);
    workbench.progress("vertex_in_wall", 0.8);
    const Lighting sky =
        lighting_from_cubemap(constant_sky(fine.scene()->face_resolution(), 1));
    view::Look look = fine.scene()->beginning();
    look.width = look.height = kSide;
    const RelitImage truth = image_under_white_sky(scene, look);
    const RelitImage coarse_image = coarse.image(look, sky);
    const RelitImage fine_image = fine.image(look, sky);
    Outcome outcome;
    outcome.findings = {
        {fmt::format("{} vertices: light that is missing around the block, of all",
                     coarse_vertices),
         Sense::at_least, 0.01, darkness(coarse_image, truth),
         "triangles hang on vertices that see nothing"},
        {fmt::format("{} vertices: the same", fine_vertices), Sense::at_most,
         darkness(coarse_image, truth) / 3, darkness(fine_image, truth),
         "edges that lead into the block are cut until what hangs on them is a line"},
        {fmt::format("{} vertices: relative L2 error", fine_vertices), Sense::at_most, 0.06,
         distance(fine_image, truth) / norm(truth),
         "of which the outlines of the block, which the truth looks at in one place, are most"},
    };
    outcome.tiles = {{truth, "rays at every pixel"},
                     {coarse_image, fmt::format("{} vertices", coarse_vertices)},
                     {fine_image, fmt::format("{} vertices", fine_vertices)},
                     {absolute_difference(fine_image, truth, 4), "how far it is off, x4"}};
    return outcome;
}

}  // namespace

Failure vertex_in_wall() {
    return {.name = "vertex_in_wall",
            .what = "a vertex inside a wall darkens what is around it",
            .scene =
                "a block on a floor whose vertices it covers, under a white sky, 96x96, "
                "n = 16",
            .provoke = provoke};
}

}  // namespace relume::stability
