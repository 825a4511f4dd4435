// relume-lab view-terms: how many terms of a BRDF an image needs.
#include "precompute/scene/builtin.h"
#include "tests/lab/charts/view_terms_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/geometry/view_terms.h"
#include "tests/lab/sequences/environment_source.h"
#include "tests/lab/sequences/map_cubemap.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

struct Options {
    std::vector<std::string> scenes{"street", "table"};
    std::vector<std::string> lights{"studio", "night", "sky-overcast", "bare-sun"};
    ViewTermsOptions views;
    bool json = false;
    std::string output;
};

// As Markdown, so that it can stand in a README.
void print_heading(std::uint32_t terms) {
    std::string heading = "| scene | light |";
    std::string rule = "|---|---|";
    for (std::uint32_t k = 1; k <= terms; ++k) {
        heading += fmt::format(" {} |", k);
        rule += "---|";
    }
    fmt::print("{}\n{}\n", heading, rule);
}

void print(const ViewTermsPanel& panel) {
    for (std::size_t light = 0; light < panel.found.size(); ++light) {
        const ViewTerms& found = panel.found[light];
        std::string line = fmt::format("| {} | {} |", panel.title, panel.lights[light]);
        for (std::size_t k = 0; k < found.errors.size(); ++k) {
            line += fmt::format(" {:.1f} ({:.1f}) % |", 100 * found.errors[k],
                                100 * found.worst[k]);
        }
        fmt::print("{}\n", line);
    }
    std::fflush(stdout);
}

nlohmann::json json_from(const ViewTermsPanel& panel) {
    nlohmann::json lights = nlohmann::json::object();
    for (std::size_t light = 0; light < panel.found.size(); ++light) {
        lights[panel.lights[light]] = {{"errors", panel.found[light].errors},
                                       {"worst_view", panel.found[light].worst},
                                       {"points", panel.found[light].points}};
    }
    return lights;
}

int run(const Options& options) {
    catch_interruption();
    if (!options.output.empty()) {
        std::filesystem::create_directories(options.output);
    }
    std::vector<bake::CubemapLight> lights;
    for (const std::string& name : options.lights) {
        lights.push_back(cubemap_of_map(name, options.views.face_resolution));
    }
    std::vector<ViewTermsPanel> panels;
    nlohmann::json report = nlohmann::json::object();
    if (!options.json) {
        print_heading(options.views.most_terms);
    }
    for (const std::string& name : options.scenes) {
        if (is_interrupted()) {
            return kInterrupted;
        }
        panels.push_back({.title = name,
                          .lights = options.lights,
                          .found = measure_view_terms(scene::build_builtin_scene(name), lights,
                                                      options.views)});
        report[name] = json_from(panels.back());
        if (!options.json) {
            print(panels.back());
        }
    }
    if (options.json) {
        fmt::print("{}\n", report.dump(2));
    }
    if (!options.output.empty()) {
        draw_view_terms_chart(std::filesystem::path(options.output) / "view-terms", panels);
    }
    return 0;
}

}  // namespace

Command add_view_terms_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "view-terms",
        "errors of images by 1 to 10 terms of every material, by views and lights");
    const auto add = [command](const char* name, auto& value, const char* text) {
        return command->add_option(name, value, text)->capture_default_str();
    };
    add("--scenes", options->scenes, "built-in scenes")->delimiter(',');
    add("--lights", options->lights, "environments, as of `run`")->delimiter(',');
    add("--views", options->views.views, "around what the scene's camera looks at")
        ->check(CLI::Range(1, 360));
    add("--side", options->views.side, "of an image, in points")->check(CLI::Range(1, 1024));
    add("--light-resolution", options->views.face_resolution, "as of relume-bake")
        ->check(CLI::IsMember({4, 8, 16, 32, 64}));
    add("--terms", options->views.most_terms, "at most")->check(CLI::Range(1, 16));
    command->add_flag("--json", options->json, "JSON instead of a table");
    command->add_option("-o,--output", options->output, "folder for the chart");
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
