// relume-lab light-filter: what an exact image is exact for, and how far that is from the map.
#include "precompute/scene/builtin.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/measures/light_filter.h"
#include "tests/lab/sequences/environment_source.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace relume::lab {
namespace {

struct Options {
    std::vector<std::string> scenes{"table", "thin", "bowl"};
    std::vector<std::string> environments{"studio", "sunset", "city", "night", "bare-sun"};
    std::vector<std::uint32_t> face_resolutions{16, 32, 64};
    std::vector<float> other_sharpenings{0};
    bool is_walk = false;
    LightFilterOptions measure;
};

std::string text_of(const Measured& measured) {
    return measured.value < measured.least ? fmt::format("below {:.2f} %", 100 * measured.least)
                                           : fmt::format("{:.2f} %", 100 * measured.value);
}

std::string text_of(const LightWalk& walk) {
    return fmt::format("{}, {:.2f} %", text_of(walk.flicker), 100 * walk.energy_range);
}

// Of one n: as it is served, sharpened otherwise, and the mean of each texel.
std::vector<TexelLightSource> sources_of(const std::string& map,
                                         std::uint32_t n,
                                         const Options& options) {
    std::vector<TexelLightSource> sources{{n, load_environment(map, n)}};
    for (const float sharpening : options.other_sharpenings) {
        sources.push_back({n, load_environment(map, n, sharpening)});
    }
    sources.push_back({n, nullptr});
    return sources;
}

template <typename Value>
void print_row(const std::string& scene,
               const std::string& map,
               std::uint32_t n,
               std::span<const Value> values) {
    fmt::print("| {} | {} | {} |", scene, map, n);
    for (const Value& value : values) {
        fmt::print(" {} |", text_of(value));
    }
    fmt::print("\n");
    std::fflush(stdout);
}

void print_scene(const std::string& name, const std::string& map, const Options& options) {
    const scene::Scene scene = scene::build_builtin_scene(name);
    std::vector<TexelLightSource> all;
    for (const std::uint32_t n : options.face_resolutions) {
        for (TexelLightSource& source : sources_of(map, n, options)) {
            all.push_back(std::move(source));
        }
    }
    const light::EnvironmentMap& source_map = all.front().environment->source();
    const std::size_t in_row = all.size() / options.face_resolutions.size();
    std::vector<Measured> distances;
    if (!options.is_walk) {
        distances = light_filter_distances(scene, source_map, all, options.measure);
    }
    for (std::size_t i = 0; i < options.face_resolutions.size(); ++i) {
        const std::uint32_t n = options.face_resolutions[i];
        if (options.is_walk) {
            const auto of_row = std::span(std::as_const(all)).subspan(i * in_row, in_row);
            const auto walks = light_walks(scene, source_map, of_row, options.measure);
            print_row<LightWalk>(name, map, n, walks);
        } else {
            print_row<Measured>(name, map, n, std::span(distances).subspan(i * in_row, in_row));
        }
    }
}

// As Markdown, so that it can stand in a README.
int run(const Options& options) {
    catch_interruption();
    std::string heading = "| scene | light | n | as filtered |";
    std::string rule = "|---|---|---|---|";
    for (const float sharpening : options.other_sharpenings) {
        heading += fmt::format(" sharpened by {} |", sharpening);
        rule += "---|";
    }
    fmt::print("{} mean of each texel |\n{}---|\n", heading, rule);
    for (const std::string& map : options.environments) {
        for (const std::string& scene : options.scenes) {
            if (is_interrupted()) {
                return kInterrupted;
            }
            print_scene(scene, map, options);
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
    command
        ->add_option("--sharpenings", options->other_sharpenings,
                     "beside the one that is served")
        ->delimiter(',')
        ->capture_default_str();
    command->add_flag("--walk", options->is_walk,
                      "turns by tenths of a texel instead: flicker, and how energy varies");
    command->add_option("--size", options->measure.image_side, "pixels a side")
        ->capture_default_str();
    command->add_option("--samples", options->measure.samples, "paths a pixel, twice")
        ->capture_default_str();
    command->add_option("--turns", options->measure.turns, "about the vertical")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
