// relume-lab triple-pareto: error against time of triple products and of what else shows a
// surface whose light and view move.
#include "tests/lab/charts/triple_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/lab/triple/triple_pareto.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <filesystem>
#include <memory>
#include <string>

namespace relume::lab {
namespace {

using nlohmann::json;

struct Options {
    TripleParetoOptions pareto;
    std::string cache = default_scene_cache();
    std::uint32_t threads = 2;
    bool as_json = false;
    std::string output;  // a folder
};

json json_from(const TriplePareto& pareto) {
    json panels = json::object();
    for (const TripleParetoPanel& panel : pareto.panels) {
        json points = json::array();
        for (const TripleParetoPoint& point : panel.points) {
            points.push_back({{"series", point.series},
                              {"setting", point.setting},
                              {"milliseconds", point.milliseconds},
                              {"error", point.error}});
        }
        panels[panel.moving] = std::move(points);
    }
    return {{"vertices", pareto.vertices},
            {"seen_vertices", pareto.seen},
            {"visibility_bytes", pareto.visibility_bytes},
            {"material_bytes", pareto.material_bytes},
            {"factored_bytes", pareto.factored_bytes},
            {"moving", std::move(panels)}};
}

// As Markdown: a row a method, a column for what moves.
void print(const TriplePareto& pareto) {
    fmt::print(
        "{} vertices, {} seen; visibility {:.1f} MB, material {:.1f} MB; factored {:.1f} "
        "MB\n\n",
        pareto.vertices, pareto.seen, 1e-6 * pareto.visibility_bytes,
        1e-6 * pareto.material_bytes, 1e-6 * pareto.factored_bytes);
    std::string heading = "| method | an image |";
    std::string rule = "|---|---|";
    for (const TripleParetoPanel& panel : pareto.panels) {
        heading += fmt::format(" {} |", panel.moving);
        rule += "---|";
    }
    fmt::print("{}\n{}\n", heading, rule);
    for (std::size_t i = 0; i < pareto.panels.front().points.size(); ++i) {
        const TripleParetoPoint& first = pareto.panels.front().points[i];
        std::string line = fmt::format("| {} | {} |", first.series, first.setting);
        for (const TripleParetoPanel& panel : pareto.panels) {
            line += fmt::format(" {:.2f} ms, {:.1f} % |", panel.points[i].milliseconds,
                                100 * panel.points[i].error);
        }
        fmt::print("{}\n", line);
    }
}

int run(Options options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    options.threads);
    options.pareto.cache = options.cache;
    const TriplePareto pareto = measure_triple_pareto(options.pareto);
    if (!options.output.empty()) {
        std::filesystem::create_directories(options.output);
        draw_triple_pareto(std::filesystem::path(options.output) / "triple-pareto", pareto);
    }
    if (options.as_json) {
        fmt::print("{}\n", json_from(pareto).dump(2));
    } else {
        print(pareto);
    }
    return 0;
}

}  // namespace

Command add_triple_pareto_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* app = program.add_subcommand(
        "triple-pareto",
        "error against time: triple products, factored BRDFs, clustered PCA, on one surface");
    const auto add = [app](const char* name, auto& value, const char* text) {
        return app->add_option(name, value, text)->capture_default_str();
    };
    add("--scene", options->pareto.scene, "built in; all of it of one GGX material");
    add("--roughness", options->pareto.roughness, "of the material")
        ->check(CLI::Range(0.05, 1.0));
    add("--environment", options->pareto.environment, "name or file");
    add("--vertices", options->pareto.vertices, "at most");
    add("-n,--light-resolution", options->pareto.face_resolution,
        "texels along a face, 4 to 64")
        ->check(CLI::IsMember({4, 8, 16, 32, 64}));
    add("--terms", options->pareto.terms, "of the factored BRDF")->check(CLI::Range(4, 16));
    add("--side", options->pareto.side, "of images, in pixels")->check(CLI::Range(16, 4096));
    add("--images", options->pareto.images, "of each movement")->check(CLI::Range(2, 10'000));
    add("--threads", options->threads, "of all")->check(CLI::Range(1, 1024));
    add("--cache", options->cache, "where the surface is baked to and kept");
    app->add_flag("--json", options->as_json, "one JSON object");
    app->add_option("-o,--output", options->output, "folder for the chart");
    return {app, [options] { return run(*options); }};
}

}  // namespace relume::lab
