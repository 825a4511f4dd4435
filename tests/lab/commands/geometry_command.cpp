// relume-lab geometry: a surface seen by a camera that moves, how fast and how exactly.
#include "precompute/bake/base/parameters.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/text/strict_json.h"
#include "protocol/base/timing/stopwatch.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/cpca/cpca_experiment.h"
#include "tests/lab/cpca/cpca_figures.h"
#include "tests/lab/geometry/drawn_room.h"
#include "tests/lab/geometry/interpolation_error.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/lab/sequences/map_cubemap.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

using nlohmann::json;

// What published systems of this kind had.
json literature() {
    return {{{"source", "Overbeck06T §7.2, §7.3"},
             {"vertices", 40'029},
             {"terms", 4},
             {"clusters", 398},
             {"bases", 25},
             {"incremental_bases", 6},
             {"coefficients_of_clusters", 100},
             {"coefficients_of_terms", 30}},
            {{"source", "Sun07 fig. 1"},
             {"vertices", 39'700},
             {"bytes", 389'000'000},
             {"bake_seconds", 44'280},
             {"images_per_s_light_view_and_brdf", 2.62},
             {"images_per_s_view_only", 57.09}}};
}

struct Options {
    LabSurface surface;
    std::string environment = "studio";
    std::uint32_t threads = 2;
    std::uint32_t images = 120;
    double milliseconds = 8;
    std::size_t points = 3000;
    std::size_t cpca_runs = 2;
    std::uint32_t cpca_light_resolution = 16;
    std::string cache = default_scene_cache();
    bool as_json = false;
};

// As LabScenes bakes it.
bake::BakeParameters parameters_of(const LabSurface& surface) {
    bake::BakeParameters parameters;
    parameters.receivers = bake::ReceiverKind::vertices;
    parameters.width = surface.side;
    parameters.height = surface.side;
    parameters.face_resolution = 32;
    parameters.bounces = 2;
    parameters.vertices = surface.vertices;
    parameters.terms = surface.terms;
    parameters.target_error = 1e-3;
    return parameters;
}

// Images per second of a loop that makes every image and its JPEG.
template <typename Edit>
double images_per_second(DrawnRoom& room,
                         const relighting::Budget& budget,
                         std::uint32_t images,
                         const Edit& edit) {
    constexpr std::uint32_t kFirst = 10;  // until caches and cost models have settled
    std::optional<timing::Stopwatch> watch;
    for (std::uint32_t image = 0; image < kFirst + images; ++image) {
        if (image == kFirst) {
            watch.emplace();
        }
        edit(image);
        room.relight(budget);
        room.show();
    }
    room.finish();
    return images / watch->seconds();
}

double relative_l2(const std::vector<float>& image, const std::vector<float>& truth) {
    double difference = 0;
    double norm = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        difference += std::pow(double{image[i]} - double{truth[i]}, 2);
        norm += std::pow(double{truth[i]}, 2);
    }
    return std::sqrt(difference / norm);
}

struct Convergence {
    double error_while_moving = 0;  // of the last image of the drag
    double error_5_images_after_rest = 0;
    std::uint32_t images_to_exact = 0;
};

// A drag of light and view ends; image by image until exact.
Convergence converge(DrawnRoom& room, const relighting::Budget& budget) {
    constexpr std::uint32_t kDrag = 60;
    for (std::uint32_t image = 0; image < kDrag; ++image) {
        room.turn_light(image);
        room.move_camera(image);
        room.relight(budget);
        room.show();
    }
    constexpr std::size_t kFifth = 5;
    constexpr std::uint32_t kMost = 1000;
    std::vector<std::vector<float>> images{room.linear_image()};
    Convergence result;
    while (!room.session().exact() && result.images_to_exact < kMost) {
        room.relight(budget);
        ++result.images_to_exact;
        if (images.size() <= kFifth) {
            images.push_back(room.linear_image());
        }
    }
    const std::vector<float> exact = room.linear_image();
    result.error_while_moving = relative_l2(images.front(), exact);
    result.error_5_images_after_rest =
        images.size() > kFifth ? relative_l2(images[kFifth], exact) : 0;
    return result;
}

double bake_seconds(const served::Scene& scene) {
    constexpr std::size_t kMost = 1 << 20;
    const json report = text::parse_strict_json(
        files::read_regular_file(scene.transport().directory() / "report.json", kMost), kMost);
    return report.at("seconds").at("total").get<double>();
}

// Of runs of the surface's clusters, as `relume-lab cpca` measures them.
json cpca_figures_of(const Options& options) {
    CpcaOptions cpca;
    cpca.bake = parameters_of(options.surface);
    cpca.bake.face_resolution = options.cpca_light_resolution;
    cpca.most_runs = options.cpca_runs;
    cpca.sequence = load_sequence("quick-turn");
    cpca.environments.environment =
        load_environment(options.environment, cpca.bake.face_resolution);
    return cpca_figures(
        run_cpca_experiment(scene::build_builtin_scene(options.surface.scene), cpca));
}

int run(const Options& options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    const auto scene = LabScenes(options.cache).surface(options.surface);
    const transport::Manifest& manifest = scene->transport().manifest();
    const relighting::Budget budget{
        .milliseconds = options.milliseconds, .coefficients = {}, .target_error = 0};
    const auto environment = load_environment(options.environment, scene->face_resolution());
    json figures;
    {
        DrawnRoom room(scene, environment, options.surface.side);
        figures["images_per_s_light_and_view"] =
            images_per_second(room, budget, options.images, [&](std::uint32_t image) {
                room.turn_light(image);
                room.move_camera(image);
            });
        figures["images_per_s_light_only"] = images_per_second(
            room, budget, options.images, [&](std::uint32_t image) { room.turn_light(image); });
        while (!room.session().exact()) {
            room.relight(budget);
        }
        figures["images_per_s_view_only"] =
            images_per_second(room, budget, options.images,
                              [&](std::uint32_t image) { room.move_camera(image); });
    }
    {
        DrawnRoom room(scene, environment, options.surface.side);
        const Convergence found = converge(room, budget);
        figures["error_while_moving"] = found.error_while_moving;
        figures["error_5_images_after_rest"] = found.error_5_images_after_rest;
        figures["images_to_exact"] = found.images_to_exact;
    }
    bake::BakeParameters parameters = parameters_of(options.surface);
    constexpr std::uint32_t kPathsOfPoint = 1024;
    parameters.samples = kPathsOfPoint;
    parameters.shrinkage = 0;
    const InterpolationError interpolation = interpolation_error(
        scene::build_builtin_scene(options.surface.scene), scene->transport(), parameters,
        cubemap_of_map(options.environment, scene->face_resolution()), options.points);
    figures["interpolation_error"] = interpolation.relative_l2;
    figures["interpolation_error_of_exact_corners"] = interpolation.of_exact_corners;
    figures["bake_seconds"] = bake_seconds(*scene);
    figures["bytes"] = scene->transport().total_bytes();
    if (options.cpca_runs > 0) {
        figures.update(cpca_figures_of(options));
    }
    const json configuration{
        {"scene", options.surface.scene},
        {"environment", options.environment},
        {"side", options.surface.side},
        {"threads", options.threads},
        {"vertices", manifest.layout.clusters().vertex_count()},
        {"clusters", manifest.layout.clusters().clusters().size()},
        {"blocks", manifest.block_count()},
        {"block_basis", transport::kBlockBasisNames.name(manifest.block_basis)},
        {"terms", options.surface.terms},
        {"milliseconds", options.milliseconds},
        {"points", interpolation.points},
        {"cpca_runs", options.cpca_runs},
        {"cpca_light_resolution", options.cpca_light_resolution}};
    if (options.as_json) {
        fmt::print("{}\n", json{{"configuration", configuration},
                                {"literature", literature()},
                                {"figures", figures}}
                               .dump(2));
        return 0;
    }
    for (const auto& [key, value] : configuration.items()) {
        fmt::print("{:28} {}\n", key, value.dump());
    }
    for (const auto& [key, value] : figures.items()) {
        fmt::print("| `{}` | {:.4g} |\n", key, value.get<double>());
    }
    return 0;
}

}  // namespace

Command add_geometry_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "geometry", "speed and errors of a surface that is seen by a camera that moves");
    app->add_option("--scene", options->surface.scene, "built-in scene")->capture_default_str();
    app->add_option("--environment", options->environment, "name or file")
        ->capture_default_str();
    app->add_option("--side", options->surface.side, "of images, in pixels")
        ->capture_default_str();
    app->add_option("--vertices", options->surface.vertices, "at most")->capture_default_str();
    app->add_option("--terms", options->surface.terms, "of every material")
        ->capture_default_str();
    app->add_option("--threads", options->threads, "of all that is timed")
        ->capture_default_str();
    app->add_option("--images", options->images, "that are timed")->capture_default_str();
    app->add_option("--budget-ms", options->milliseconds, "of relighting, an image")
        ->capture_default_str();
    app->add_option("--points", options->points, "that get rows of their own")
        ->capture_default_str();
    app->add_option("--cpca-runs", options->cpca_runs,
                    "of sixteen clusters whose clustered PCA is measured")
        ->capture_default_str();
    app->add_option("--cpca-light-resolution", options->cpca_light_resolution,
                    "n of its rows, which are in memory")
        ->capture_default_str();
    app->add_option("--cache", options->cache, "folder of baked scenes")->capture_default_str();
    app->add_flag("--json", options->as_json, "one JSON object");
    return {app, [options] { return run(*options); }};
}

}  // namespace relume::lab
