// Camera and light that move at once: what the view does not see is passed by, and must be made
// up for when the camera turns to it.
#include "precompute/scene/builtin/mesh_builder.h"
#include "tests/stability/mesh/baked_surface.h"
#include "tests/stability/provocations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace relume::stability {
namespace {

constexpr std::uint32_t kSide = 64;
constexpr relighting::Budget kBudget{
    .milliseconds = 1e6, .coefficients = 12, .target_error = 0};

// A viewer with a session and a view of their own, as a room has them.
class Viewer {
  public:
    explicit Viewer(const served::Scene& scene)
        : session_(scene.workspace(),
                   {.method = relighting::Method::bi, .priority = relighting::Priority::area}),
          view_(scene.make_view()) {}

    void light(const Lighting& lighting) { session_.set_target(lighting); }
    // Tells the engine what shows, or, as it should not, says nothing.
    void look(const view::Look& look, bool tells_engine = true) {
        view_->look(look);
        if (tells_engine) {
            session_.set_block_weights(view_->block_weights());
        }
    }
    void step() { session_.advance(kBudget); }
    // Only what light chose, never the full product.
    void step_incrementally() {
        session_.advance_incrementally(
            {.columns = 12, .bytes = std::numeric_limits<std::uint64_t>::max()});
    }
    void rest() { run_until_exact(session_); }
    [[nodiscard]] bool is_exact() const { return session_.exact(); }
    [[nodiscard]] RelitImage image() {
        view_->sums_have_changed();
        RelitImage image{view_->image().width, view_->image().height, {}};
        image.rgb.resize(std::size_t{3} * image.width * image.height);
        view::write_image(*view_, session_.sums(), image.rgb);
        return image;
    }

  private:
    engine::Session session_;
    std::unique_ptr<view::View> view_;
};

// Two walls that face each other, of a grid of vertices each: they are stored apart, and who
// looks at one of them does not see the other.
scene::Scene two_walls() {
    scene::Scene scene;
    scene.name = "two-walls";
    scene.materials.push_back({.name = "white", .base_colour = Imath::V3f(0.8F)});
    constexpr std::uint32_t kPoints = 33;
    for (const float side : {-1.0F, 1.0F}) {
        scene::MeshBuilder wall("wall", 0);
        wall.add_grid(kPoints, kPoints, scene::Closing::open, scene::Closing::open,
                      [side](std::uint32_t i, std::uint32_t j) {
                          const float along = static_cast<float>(j) / 4 - 4;
                          return Imath::V3f(3 * side, static_cast<float>(i) / 4 - 4,
                                            along * side);
                      });
        scene.meshes.push_back(wall.take());
    }
    scene.camera = {.name = "between",
                    .eye = {0, 0, 0},
                    .look_at = {3, 0, 0},
                    .up = {0, 1, 0},
                    .vertical_fov_degrees = 60};
    finish_scene(scene);
    return scene;
}

// From between the walls; 90 and 270 degrees lead to the middle of one.
view::Look look_to(const served::Scene& scene, double degrees, double fov) {
    view::Look look = scene.beginning();
    const double angle = degrees * std::numbers::pi / 180;
    look.look_at = look.eye + Imath::V3d(std::sin(angle), 0.1, -std::cos(angle));
    look.fov_degrees = fov;
    look.width = look.height = kSide;
    return look;
}

Lighting light_from(std::uint32_t n, float azimuth) {
    return sky_and_disc(n, 0.2F,
                        {.direction = direction_from_degrees(azimuth, 25),
                         .angular_radius_radians = radians_from_degrees(10),
                         .radiance = Imath::V3f(30)});
}

double values_that_differ(const RelitImage& a, const RelitImage& b) {
    double count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        count += a.rgb[i] == b.rgb[i] ? 0 : 1;
    }
    return count;
}

struct Turned {
    double untold = 0;  // error of who is not told, over the image
    double told = 0;
    RelitImage of_untold, of_told, steady;
};

// Light moves while the camera looks away; then it turns to where it has not looked.
Turned turn_around(const served::Scene& scene) {
    const std::uint32_t n = scene.face_resolution();
    const view::Look away = look_to(scene, 90, 50);
    const view::Look there = look_to(scene, -90, 50);
    Viewer told(scene);
    Viewer untold(scene);
    Viewer steady(scene);  // has looked there all the time
    for (Viewer* viewer : {&told, &untold, &steady}) {
        viewer->look(viewer == &steady ? there : away);
        viewer->light(light_from(n, 0));
        viewer->rest();
    }
    for (int step = 1; step <= 12; ++step) {
        for (Viewer* viewer : {&told, &untold, &steady}) {
            viewer->light(light_from(n, static_cast<float>(15 * step)));
            viewer->step_incrementally();
        }
    }
    told.look(there);
    untold.look(there, false);
    Turned turned{
        .of_untold = untold.image(), .of_told = told.image(), .steady = steady.image()};
    turned.untold = distance(turned.of_untold, turned.steady) / norm(turned.steady);
    turned.told = distance(turned.of_told, turned.steady) / norm(turned.steady);
    return turned;
}

struct Wandered {
    double exact_images = 0;
    double wrong_bits = 0;      // values of exact images that are not those of a fresh session
    double lost_exactness = 0;  // edits of the view alone after which the image is not exact
};

// Random edits of light and view at once, with images in between and some rest.
Wandered wander(const served::Scene& scene, int edits) {
    const std::uint32_t n = scene.face_resolution();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> degrees(0, 360);
    std::uniform_real_distribution<double> fov(20, 120);
    Wandered wandered;
    Viewer viewer(scene);
    for (int edit = 0; edit < edits; ++edit) {
        const Lighting lighting = light_from(n, static_cast<float>(degrees(random)));
        viewer.light(lighting);
        for (int image = 0; image < 3; ++image) {
            viewer.look(look_to(scene, degrees(random), fov(random)));
            viewer.step();
            (void)viewer.image();
        }
        viewer.rest();
        for (int turn = 0; turn < 3; ++turn) {
            const view::Look look = look_to(scene, degrees(random), fov(random));
            viewer.look(look);
            wandered.lost_exactness += viewer.is_exact() ? 0 : 1;
            Viewer fresh(scene);
            fresh.look(look);
            fresh.light(lighting);
            fresh.rest();
            wandered.wrong_bits += values_that_differ(viewer.image(), fresh.image());
            ++wandered.exact_images;
        }
    }
    return wandered;
}

Outcome provoke(Workbench& workbench) {
    bake::BakeParameters parameters = surface_parameters(10'000);
    parameters.target_error = 1;  // the vertices are there
    const BakedSurface surface(two_walls(), parameters);
    workbench.progress("moving_view", 0.5);
    const served::Scene& scene = *surface.scene();
    const Turned turned = turn_around(scene);
    const Wandered wandered = wander(scene, workbench.choose(8, 200));
    Outcome outcome;
    outcome.findings = {
        {"turned to what was passed by, the engine not told: image error", Sense::at_least, 0.1,
         turned.untold, "it shows light of twelve edits ago"},
        {"told: the same, beside who looked there all the time", Sense::at_most, 1e-5,
         turned.told, "the columns that were passed by are made up for; rounding is left"},
        {"light and view edited at once: values of exact images that are not a fresh session's",
         Sense::at_most, 0, wandered.wrong_bits,
         "an exact image depends on light and look alone"},
        {"edits of the view alone after which the image is not exact", Sense::at_most, 0,
         wandered.lost_exactness, "an exact image is exact in all blocks"},
    };
    const float exposure = exposure_for(turned.steady);
    outcome.tiles = {{turned.steady, "who looked there all the time", exposure},
                     {turned.of_told, "turned there, told", exposure},
                     {turned.of_untold, "turned there, not told", exposure},
                     {absolute_difference(turned.of_untold, turned.steady, 1),
                      "what it is off by", exposure}};
    return outcome;
}

}  // namespace

Failure moving_view() {
    return {
        .name = "moving_view",
        .what = "a view that moves while the light does shows the light of before",
        .scene =
            "two walls of 1089 vertices a side from between them, a lamp of 10 degrees going "
            "around, "
            "64x64, n = 16",
        .provoke = provoke};
}

}  // namespace relume::stability
