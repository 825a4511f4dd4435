// relume-lab triple: light times visibility times material at the vertices that a camera sees.
#include "server/engine/kernels/target.h"
#include "tests/lab/charts/picture_sheet.h"
#include "tests/lab/charts/triple_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/lab/sequences/map_cubemap.h"
#include "tests/lab/triple/kept_products.h"
#include "tests/lab/triple/moving_scene.h"
#include "tests/lab/triple/triple_experiment.h"
#include "tests/lab/triple/triple_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

using nlohmann::json;

struct Options {
    LabVisibility surface;
    std::vector<std::string> materials{"lambert", "phong:exponent=64"};
    std::string environment = "studio";
    std::uint32_t side = 512;  // of images, in pixels
    std::uint32_t threads = 2;
    std::size_t peer_vertices = 400;
    std::uint32_t images = 24;
    bool is_full = false;
    std::vector<std::string> models;  // files, beside what is full
    bool keeps = false;
    bool as_json = false;
    std::string pictures;  // a folder
    std::string cache = default_scene_cache();
};

// A surface, and what is put on it.
struct Subject {
    LabVisibility surface;
    std::vector<std::string> materials;
};

std::vector<Subject> subjects_of(const Options& options) {
    constexpr std::uint32_t kTableOfPaper = 300'000;
    constexpr std::uint32_t kBuddhaOfPaper = 93'000;
    constexpr const char* kPhong = "phong:exponent=64";
    std::vector<Subject> subjects;
    const auto add = [&](const std::string& scene, std::uint32_t vertices) -> Subject& {
        Subject& subject = subjects.emplace_back();
        subject.surface.scene = scene;
        subject.surface.vertices = vertices;
        subject.surface.face_resolution = options.surface.face_resolution;
        return subject;
    };
    if (!options.is_full) {
        add(options.surface.scene, options.surface.vertices).materials = options.materials;
        return subjects;
    }
    add("table", kTableOfPaper).materials = options.materials;
    add("mesh100k", kBuddhaOfPaper).materials.emplace_back(kPhong);
    for (const std::string& model : options.models) {
        add(model, options.surface.vertices).materials.emplace_back(kPhong);
    }
    return subjects;
}

// The grid of [Ng04 fig. 4]: a row a fraction of the material's terms, a column one of the
// light's.
void draw_pictures(const std::filesystem::path& folder,
                   const SeenSurface& surface,
                   const TabulatedMaterial& material,
                   const TripleLight& light,
                   const std::string& scene) {
    const auto exact =
        integrate_all(surface, bits_way(surface, material, material.texels(), light));
    std::vector<Picture> pictures;
    for (std::size_t f = 0; f < kMaterialFractions.size(); ++f) {
        for (const double of_light : kLightFractions) {
            const tripling::SquareSet terms = light.largest(of_light);
            const auto radiance =
                integrate_all(surface, sublinear_way(surface, material, f, light, terms));
            pictures.push_back(
                {.method = fmt::format("{:g} %, {:g} %: {:.1f} %", 100 * kMaterialFractions[f],
                                       100 * of_light, 100 * relative_l2(radiance, exact)),
                 .image = 0,
                 .rgb = surface.image(radiance)});
        }
    }
    std::filesystem::create_directories(folder);
    const std::string name = material.words().substr(0, material.words().find(':'));
    draw_picture_grid(folder / ("triple-" + name),
                      scene + ", " + material.words() +
                          ": terms of the material, terms of the light: relative L2 error",
                      surface.image(exact), pictures, kLightFractions.size(), surface.side());
}

json measure(const Options& options, const Subject& subject, LabScenes& scenes) {
    const std::uint32_t n = subject.surface.face_resolution;
    const SeenSurface surface(scenes.visibility(subject.surface), options.side);
    const TripleLight light(n, cubemap_of_map(options.environment, n));
    json materials = json::array();
    std::vector<TermCurve> curves;
    for (const std::string& words : subject.materials) {
        const TabulatedMaterial material(words, n, kMaterialFractions);
        const MaterialFindings findings =
            measure_material(surface, material, light, options.peer_vertices);
        curves.push_back(time_against_terms(surface, material, light));
        materials.push_back(json_from(findings, curves.back()));
        materials.back()["moving"] =
            json_from(move_scene(surface, words, options.environment, options.images));
        if (options.keeps) {
            materials.back()["kept"] = json_from(
                measure_kept_products(surface, material, options.environment, options.images));
        }
        if (!options.pictures.empty()) {
            draw_pictures(options.pictures, surface, material, light, subject.surface.scene);
        }
    }
    if (!options.pictures.empty()) {
        draw_triple_chart(std::filesystem::path(options.pictures) / "triple-terms",
                          subject.materials, curves);
    }
    return {{"configuration",
             {{"scene", subject.surface.scene},
              {"environment", options.environment},
              {"face_resolution", n},
              {"side", options.side},
              {"threads", options.threads},
              {"target", engine::target_name()},
              {"material_terms", kMaterialFractions[kPaperMaterial]},
              {"light_terms", kLightFractions[kPaperLight]}}},
            {"visibility", json_from(surface)},
            {"materials", std::move(materials)}};
}

int run(const Options& options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    LabScenes scenes(options.cache);
    json surfaces = json::array();
    for (const Subject& subject : subjects_of(options)) {
        surfaces.push_back(measure(options, subject, scenes));
        if (!options.as_json) {
            print_triple_tables(surfaces.back());
            std::fflush(stdout);
        }
    }
    if (options.as_json) {
        fmt::print("{}\n",
                   (options.is_full ? json{{"surfaces", surfaces}} : surfaces.front()).dump(2));
    }
    return 0;
}

}  // namespace

Command add_triple_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "triple", "light times visibility times material: how fast, how exactly, and peers");
    app->add_option("--scene", options->surface.scene,
                    "built-in scene, or a file that relume-bake reads")
        ->capture_default_str();
    app->add_option("--environment", options->environment, "name or file")
        ->capture_default_str();
    app->add_option("--vertices", options->surface.vertices, "at most")->capture_default_str();
    app->add_option("-n,--light-resolution", options->surface.face_resolution,
                    "texels along a face, 4 to 256")
        ->capture_default_str();
    app->add_option("--side", options->side, "of images, in pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    app->add_option("--material", options->materials,
                    "as relume-bake material --model takes it; several with blanks")
        ->take_all();
    app->add_option("--threads", options->threads, "of all but rates a core")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app->add_option("--peer-vertices", options->peer_vertices, "that rates are measured with")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    app->add_option("--images", options->images, "of light and camera that move")
        ->check(CLI::Range(2, 10'000))
        ->capture_default_str();
    app->add_flag("--full", options->is_full,
                  "table by 300,000 vertices and mesh100k by 93,000, as [Ng04]'s table");
    app->add_option("--model", options->models, "files beside them, by --vertices")
        ->check(CLI::ExistingFile);
    app->add_flag("--keep", options->keeps,
                  "what keeping products of two factors would take and save");
    app->add_option("--pictures", options->pictures, "folder for images and a chart");
    app->add_option("--cache", options->cache, "where surfaces are baked to and kept")
        ->capture_default_str();
    app->add_flag("--json", options->as_json, "one JSON object");
    return {app, [options] { return run(*options); }};
}

}  // namespace relume::lab
