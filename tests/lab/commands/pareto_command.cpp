// relume-lab pareto: error against cost for every method, on several scenes and lights.
#include "protocol/base/files/atomic_file.h"
#include "tests/lab/charts/pareto_chart.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/progress.h"
#include "tests/lab/measures/equal_cost.h"
#include "tests/lab/measures/experiment.h"
#include "tests/lab/measures/summary.h"
#include "tests/lab/report/html_page.h"
#include "tests/lab/scenes/lab_scenes.h"
#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

struct ParetoOptions {
    std::vector<std::string> scenes;
    std::vector<std::string> lights{"studio", "night", "sky-overcast", "bare-sun"};
    std::vector<std::string> methods;  // with {} for the budget
    std::vector<std::uint32_t> budgets{10, 30, 100, 300};
    std::string sequence;
    bool of_surfaces = false;
    LabSurface surface{.vertices = 10'000, .side = 256};
    std::string cache = default_scene_cache();
    std::string output = "out/pareto";
};

// What is left out on the command line: of images, or of surfaces under a moving camera.
void add_defaults(ParetoOptions& options) {
    const bool surfaces = options.of_surfaces;
    if (options.scenes.empty()) {
        options.scenes = surfaces
                             ? std::vector<std::string>{"street"}
                             : std::vector<std::string>{"table", "box", "thin", "mesh100k"};
    }
    if (options.sequence.empty()) {
        options.sequence = surfaces ? "turn-and-orbit" : "quick-turn";
    }
    if (!options.methods.empty()) {
        return;
    }
    options.methods = {"nwa-{}-area", "nwa-{}-transport", "bi-{}-area",
                       "pbi-{}-area", "pbi-{}-transport", "guarded-{}-transport"};
    if (surfaces) {
        options.methods = {"full-product",
                           "factored-k1-{}",
                           "factored-k4-{}",
                           "cpca-c64-s12-{}",
                           "cpca-c64-s24-{}",
                           "cpca-c64-s64-{}",
                           "cpca-c128-s12-{}",
                           "cpca-c128-s24-{}",
                           "cpca-c128-s64-{}",
                           "sh-5",
                           "sh-8",
                           "sh-10",
                           "sh-15",
                           "sh-20"};
    }
}

std::vector<Method> methods_from(const ParetoOptions& options) {
    std::vector<Method> methods;
    for (const std::string& form : options.methods) {
        const std::size_t place = form.find("{}");
        if (place == std::string::npos) {
            methods.push_back(method_from_text(form));
            continue;
        }
        for (const std::uint32_t budget : options.budgets) {
            std::string text = form;
            methods.push_back(method_from_text(text.replace(place, 2, std::to_string(budget))));
        }
    }
    return methods;
}

std::string csv_from(const std::vector<ParetoPanel>& panels) {
    std::string csv = "scene_and_light,method,l2,h1,flicker,bytes,milliseconds\n";
    for (const ParetoPanel& panel : panels) {
        for (const Summary& s : panel.summaries) {
            csv += fmt::format("\"{}\",{},{},{},{},{},{:.4f}\n", panel.title, s.method, s.l2,
                               s.h1, s.flicker, s.bytes, s.microseconds / 1e3);
        }
    }
    return csv;
}

LabScene scene_of(const ParetoOptions& options, LabScenes& scenes, const std::string& name) {
    if (!options.of_surfaces) {
        return {.haar = scenes.scene(name), .sh_transport = {}};
    }
    LabSurface surface = options.surface;
    surface.scene = name;
    return {.haar = scenes.surface(surface), .sh_transport = scenes.sh_transport(surface)};
}

// Panels of all scenes and lights; fewer when interrupted.
std::vector<ParetoPanel> measure(const ParetoOptions& options) {
    const LightingSequence sequence = load_sequence(options.sequence);
    LabScenes scenes(options.cache);
    Experiment experiment;
    experiment.methods = methods_from(options);
    experiment.sequence = sequence;
    const std::size_t runs = options.scenes.size() * options.lights.size();
    Progress progress("image", runs * sequence.images);
    std::vector<ParetoPanel> panels;
    for (const std::string& scene : options.scenes) {
        experiment.scene = scene_of(options, scenes, scene);
        for (const std::string& light : options.lights) {
            experiment.environments = {.environment = load_environment(
                                           light, experiment.scene.haar->face_resolution()),
                                       .blend = nullptr};
            const std::string title = fmt::format("{}, {}", scene, light);
            experiment.go_on = [&](std::uint32_t done) {
                progress.update(panels.size() * sequence.images + done, title);
                return !is_interrupted();
            };
            const Findings findings = run_experiment(experiment);
            if (!findings.complete) {
                return panels;
            }
            panels.push_back({.title = title,
                              .summaries = summaries(findings.records, sequence.rests_from())});
        }
    }
    return panels;
}

// What each series leaves at the same part of the largest cost, as Markdown.
void print_equal_cost(const ParetoPanel& panel, ParetoCost cost) {
    constexpr double kParts[] = {1.0 / 64, 1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2, 1};
    std::vector<CostedMethod> methods;
    double largest = 0;
    for (const Summary& summary : panel.summaries) {
        methods.push_back(
            {.series = series_of(summary.method), .at = cost_and_error(summary, cost)});
        largest = std::max(largest, methods.back().at.cost);
    }
    std::vector<double> costs;
    std::string heading = fmt::format("| {}: {} |", panel.title, axis_of(cost));
    std::string rule = "|---|";
    for (const double part : kParts) {
        costs.push_back(part * largest);
        heading += fmt::format(" {:.3g} |", costs.back());
        rule += "---|";
    }
    fmt::print("{}\n{}\n", heading, rule);
    for (const EqualCostRow& row : errors_at_equal_cost(methods, costs)) {
        fmt::print("| {} |", row.series);
        for (const double error : row.errors) {
            fmt::print("{}",
                       std::isnan(error) ? " – |" : fmt::format(" {:.2f} % |", 100 * error));
        }
        fmt::print("\n");
    }
    fmt::print("\n");
    std::fflush(stdout);
}

void write_report(const ParetoOptions& options,
                  const std::vector<ParetoPanel>& panels,
                  bool complete) {
    const fs::path output(options.output);
    fs::create_directories(output);
    const std::string csv = csv_from(panels);
    files::write_file_atomically(output / "pareto.csv", {files::bytes_of(csv)});
    draw_pareto_chart(output / "pareto", panels.front());
    const std::size_t columns = options.lights.size();
    draw_pareto_multiples(output / "pareto-ms", panels, columns, ParetoCost::milliseconds);
    draw_pareto_multiples(output / "pareto-bytes", panels, columns, ParetoCost::bytes);
    HtmlPage page("Error against cost");
    if (!complete) {
        page.warning(fmt::format("Interrupted: {} of {} scenes and lights.", panels.size(),
                                 options.scenes.size() * options.lights.size()));
    }
    page.paragraph(
        fmt::format("Sequence {}. Methods take turns within each image; times are "
                    "medians of the step, errors means over the images while the "
                    "light moves, against the dense product of the stored transport.",
                    options.sequence));
    page.svg(output / "pareto.svg");
    page.heading("All scenes and lights, against time");
    page.svg(output / "pareto-ms.svg");
    page.heading("All scenes and lights, against bytes");
    page.svg(output / "pareto-bytes.svg");
    page.write(output / "report.html");
}

int run(ParetoOptions options) {
    catch_interruption();
    add_defaults(options);
    const std::vector<ParetoPanel> panels = measure(options);
    const bool complete = !is_interrupted();
    if (!panels.empty()) {
        write_report(options, panels, complete);
        for (const ParetoPanel& panel : panels) {
            print_equal_cost(panel, ParetoCost::bytes);
            print_equal_cost(panel, ParetoCost::milliseconds);
        }
    }
    if (!complete) {
        fmt::print(stderr, "relume-lab: interrupted after {} scenes and lights\n",
                   panels.size());
        return kInterrupted;
    }
    return 0;
}

}  // namespace

Command add_pareto_command(CLI::App& program) {
    auto options = std::make_shared<ParetoOptions>();
    CLI::App* command =
        program.add_subcommand("pareto", "chart error against cost, with the Pareto front");
    command
        ->add_option(
            "--scenes", options->scenes,
            "built-in scenes, baked when missing [table,box,thin,mesh100k; of surfaces "
            "street]")
        ->delimiter(',');
    command->add_option("--lights", options->lights, "environments, as of `run`")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--methods", options->methods,
                     "as of `run`, with {} where each budget goes [of images nwa, bi, pbi and "
                     "guarded; of surfaces the whole product, factored, cpca and sh]")
        ->delimiter(',');
    command->add_option("--budgets", options->budgets, "in coefficients")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--sequence", options->sequence,
                        "as of `run` [quick-turn; of surfaces turn-and-orbit]");
    command->add_flag("--surfaces", options->of_surfaces,
                      "of the scenes' surfaces under a camera that moves");
    command->add_option("--vertices", options->surface.vertices, "of a surface, at most")
        ->capture_default_str();
    command->add_option("--terms", options->surface.terms, "of a surface's glossy materials")
        ->capture_default_str();
    command->add_option("--side", options->surface.side, "of a surface's images, in pixels")
        ->capture_default_str();
    command->add_option("--cache", options->cache, "where scenes are baked to and kept")
        ->capture_default_str();
    command->add_option("-o,--output", options->output, "folder for charts, CSV and report")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
