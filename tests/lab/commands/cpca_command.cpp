// relume-lab cpca: clustered PCA of a surface's transport against what relume-bake stores.
#include "precompute/scene/builtin.h"
#include "protocol/base/files/atomic_file.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/cpca/cpca_experiment.h"
#include "tests/lab/cpca/cpca_figures.h"
#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

struct Options {
    std::vector<std::string> scenes{"box"};
    std::string environment = "studio";
    std::string sequence = "quick-turn";
    CpcaOptions cpca;
    bool is_json = false;
    std::string output;

    Options() {
        cpca.bake.receivers = bake::ReceiverKind::vertices;
        cpca.bake.vertices = 4096;
        cpca.bake.target_error = 0.004;
        cpca.most_runs = 4;
        cpca.bake.face_resolution = 32;
        cpca.bake.samples = 16;
    }
};

void print_coded(const CpcaFindings& findings) {
    fmt::print(
        "| stored as | asked: natural, sun | bytes | of plain | cells | bases | S: median, "
        "most "
        "| error: natural, sun | under model lights | seams added | seams shown |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < findings.coded.size(); ++i) {
        const CodedFigures& figures = findings.coded[i];
        const std::size_t plain =
            (i < findings.coded.size() / 2 ? findings.plain() : findings.plain_as_baked())
                .bytes.total();
        fmt::print(
            "| {} | {:.2f} %, {:.2f} % | {:.2f} MB | {:.3f} | {:.2f} MB | {:.2f} MB | {}, {} "
            "| {:.2f} %, {:.2f} % | {:.2f} %, {:.2f} % | {:.2f}, {:.2f} | {:.3f}, {:.3f} |\n",
            figures.name, 100 * figures.asked.natural, 100 * figures.asked.sun,
            1e-6 * static_cast<double>(figures.bytes.total()),
            static_cast<double>(figures.bytes.total()) / static_cast<double>(plain),
            1e-6 * static_cast<double>(figures.bytes.cells),
            1e-6 * static_cast<double>(figures.bytes.bases), figures.median_components,
            figures.most_components, 100 * figures.expected.natural, 100 * figures.expected.sun,
            100 * figures.measured.natural, 100 * figures.measured.sun,
            figures.natural_seams.added, figures.sun_seams.added, figures.natural_seams.shown,
            figures.sun_seams.shown);
    }
}

// Of the ways at the error asked.
void print_bands(const CpcaFindings& findings) {
    fmt::print("\n| band |");
    const std::size_t ways = findings.coded.size() / 2;
    for (std::size_t i = 0; i < ways; ++i) {
        fmt::print(" {}: kB, values |", findings.coded[i].name);
    }
    fmt::print("\n|---|---|---|---|---|\n");
    for (std::size_t band = 0; band < findings.plain().bytes_of_band.size(); ++band) {
        fmt::print("| {} |", band);
        for (std::size_t i = 0; i < ways; ++i) {
            fmt::print(" {:.0f}, {:.0f} k |", 1e-3 * findings.coded[i].bytes_of_band[band],
                       1e-3 * findings.coded[i].nonzeros_of_band[band]);
        }
        fmt::print("\n");
    }
}

// As Markdown, so that it can stand in a README.
void print(const std::string& scene, const CpcaFindings& findings) {
    fmt::print(
        "{}: {} of {} vertices, {} clusters, {} blocks of {} channels, {} columns; 1 % of the "
        "weighted rows is left by {} components in the median cluster; baked in {}\n\n",
        scene, findings.vertices, findings.surface_vertices, findings.clusters, findings.blocks,
        findings.channels, findings.columns, findings.median_rank,
        transport::kBlockBasisNames.name(findings.baked_basis));
    print_coded(findings);
    print_bands(findings);
    const std::vector<double>& errors = findings.reassignment_errors;
    fmt::print(
        "\nreassignment: {} rounds, squared distances {:.3f} of those before\n"
        "second step, a part of the components against all: {:.2f} times as fast, added error "
        "{:.2f} % (mean), {:.2f} % (worst image)\n\n",
        errors.size() - 1, errors.front() > 0 ? errors.back() / errors.front() : 1.0,
        findings.second_step.gain(), 100 * findings.second_step.added_error,
        100 * findings.second_step.worst_error);
    std::fflush(stdout);
}

int run(const Options& options) {
    catch_interruption();
    CpcaOptions cpca = options.cpca;
    bake::check_parameters(cpca.bake);
    cpca.sequence = load_sequence(options.sequence);
    cpca.environments.environment =
        load_environment(options.environment, cpca.bake.face_resolution);
    nlohmann::json report{{"parameters", bake::json_from_parameters(cpca.bake)},
                          {"scenes", nlohmann::json::object()}};
    for (const std::string& name : options.scenes) {
        if (is_interrupted()) {
            return kInterrupted;
        }
        const CpcaFindings findings =
            run_cpca_experiment(scene::build_builtin_scene(name), cpca);
        report["scenes"][name] = json_from_cpca(findings);
        if (!options.is_json) {
            print(name, findings);
        }
    }
    const std::string text = report.dump(2) + "\n";
    if (options.is_json) {
        fmt::print("{}", text);
    }
    if (!options.output.empty()) {
        files::write_file_atomically(options.output, {files::bytes_of(text)});
    }
    return 0;
}

}  // namespace

Command add_cpca_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "cpca", "bytes and seams of clustered PCA against stored blocks, at equal error");
    const auto add = [command](const char* name, auto& value, const char* text) {
        return command->add_option(name, value, text)->capture_default_str();
    };
    bake::BakeParameters& bake = options->cpca.bake;
    add("--scenes", options->scenes, "built-in scenes")->delimiter(',');
    add("--vertices", bake.vertices, "as of relume-bake");
    add("--runs", options->cpca.most_runs, "looked at, of sixteen clusters side by side")
        ->check(CLI::Range(1, 1 << 16));
    add("--target-error", bake.target_error, "the same");
    add("--terms", bake.terms, "the same");
    add("--light-resolution", bake.face_resolution, "the same");
    add("--bounces", bake.bounces, "the same");
    add("--samples", bake.samples, "the same");
    add("--error", options->cpca.error, "relative L2, under natural light and under a sun")
        ->check(CLI::Range(1e-6, 0.5));
    add("--falloff", options->cpca.falloff, "columns weigh 2^(-falloff·octave) in the PCA")
        ->check(CLI::Range(0.0, 2.0));
    add("--components", options->cpca.most_components, "of a cluster, S, at most")
        ->check(CLI::Range(1, 256));
    add("--share", options->cpca.share, "the second step adds S over this many components")
        ->check(CLI::Range(1, 256));
    add("--environment", options->environment, "of the second step: name or file");
    add("--sequence", options->sequence, "how it moves: name or file");
    command->add_flag("--json", options->is_json, "prints JSON in place of tables");
    add("-o,--output", options->output, "file for the JSON");
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
