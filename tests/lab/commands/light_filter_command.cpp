// relume-lab light-filter: what an exact image is exact for, and how far that is from the map.
#include "precompute/scene/builtin.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/measures/light_filter.h"
#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

struct Options {
    std::vector<std::string> scenes{"table", "thin", "bowl"};
    std::vector<std::string> environments{"studio", "sunset", "city", "sky-afternoon"};
    std::vector<std::uint32_t> face_resolutions{16, 32, 64};
    LightFilterOptions measure;
};

std::string text_of(const LightFilterError::Distance& distance) {
    return distance.value < distance.least ? fmt::format("below {:.2f} %", 100 * distance.least)
                                           : fmt::format("{:.2f} %", 100 * distance.value);
}

// As Markdown, so that it can stand in a README.
int run(const Options& options) {
    catch_interruption();
    fmt::print(
        "| scene | light | n | as filtered | mean of each texel |\n|---|---|---|---|---|\n");
    for (const std::string& scene_name : options.scenes) {
        const scene::Scene scene = scene::build_builtin_scene(scene_name);
        for (const std::string& name : options.environments) {
            for (const std::uint32_t n : options.face_resolutions) {
                if (is_interrupted()) {
                    return kInterrupted;
                }
                const LightFilterError error =
                    light_filter_error(scene, *load_environment(name, n), options.measure);
                fmt::print("| {} | {} | {} | {} | {} |\n", scene_name, name, n,
                           text_of(error.filtered), text_of(error.texel_means));
                std::fflush(stdout);
            }
        }
    }
    return 0;
}

}  // namespace

Command add_light_filter_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "light-filter",
        "distance of an exact image from one under the map at full resolution, path-traced");
    command->add_option("--scenes", options->scenes, "built-in scenes")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--environments", options->environments, "names or files")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--light-resolutions", options->face_resolutions, "n")
        ->delimiter(',')
        ->capture_default_str();
    command->add_option("--size", options->measure.image_side, "pixels a side")
        ->capture_default_str();
    command->add_option("--samples", options->measure.samples, "paths a pixel, twice")
        ->capture_default_str();
    command->add_option("--turns", options->measure.turns, "random rotations")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
