// relume-lab bake-noise: what the samples of a bake leave off, by kind of pixel, and its cost.
#include "precompute/bake/image_file.h"
#include "precompute/scene/builtin.h"
#include "protocol/base/files/atomic_file.h"
#include "protocol/base/program/usage.h"
#include "tests/lab/charts/noise_sheet.h"
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/progress.h"
#include "tests/lab/measures/reference_file.h"
#include "tests/lab/measures/scene_noise.h"
#include "tests/lab/scenes/lab_scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::vector<std::string> scenes{"table", "thin", "box"};
    std::vector<std::string> environments{"studio", "sunset", "city", "interior", "bare-sun"};
    double yaw_degrees = -15;
    std::uint32_t seeds = 2;
    bake::BakeParameters bake;  // size, light and bounces are the reference's
    ReferenceOptions reference;
    std::string cache = default_scene_cache() + "/bake-references";
    std::string output = "out/bake-noise";
    std::string before;
    std::vector<std::uint32_t> crop;  // left, top, width, height; none: all
};

BakeReference reference_of(const scene::Scene& scene,
                           const std::vector<ReferenceLight>& lights,
                           const Options& options) {
    const fs::path path =
        fs::path(options.cache) / reference_file_name(scene, lights, options.reference);
    if (auto found = read_reference(path, lights.size(), options.reference)) {
        return *std::move(found);
    }
    Progress progress("row", options.reference.height);
    BakeReference reference = trace_reference(
        scene, lights, options.reference,
        [&](std::uint32_t rows) { progress.update(rows, "reference of " + scene.name); });
    fs::create_directories(options.cache);
    write_reference(path, reference, options.reference);
    return reference;
}

void check_crop(const Options& options) {
    const std::vector<std::uint32_t>& crop = options.crop;
    if (!crop.empty() && (crop[2] == 0 || crop[3] == 0 ||
                          std::uint64_t{crop[0]} + crop[2] > options.reference.width ||
                          std::uint64_t{crop[1]} + crop[3] > options.reference.height)) {
        throw program::UsageError(fmt::format("crop is {}, expected a part of {}×{} pixels",
                                              fmt::join(crop, ","), options.reference.width,
                                              options.reference.height));
    }
}

// The reference, what an earlier run left in `before` where that is given, and the bake.
void write_pictures(const std::string& scene,
                    const BakeReference& reference,
                    const SceneNoise& noise,
                    const Options& options) {
    const std::uint32_t width = options.reference.width;
    const std::uint32_t height = options.reference.height;
    const Crop crop = options.crop.empty() ? Crop{.width = width, .height = height}
                                           : Crop{options.crop[0], options.crop[1],
                                                  options.crop[2], options.crop[3]};
    for (std::size_t i = 0; i < options.environments.size(); ++i) {
        const std::string name =
            fmt::format("{}-{}", scene, fs::path(options.environments[i]).stem().string());
        std::vector<std::vector<float>> pictures{reference.lit[i].picture()};
        if (!options.before.empty()) {
            pictures.push_back(
                read_picture(fs::path(options.before) / (name + ".exr"), width, height));
        }
        pictures.push_back(noise.pictures[i]);
        const bake::FloatImage image{
            .width = width, .height = height, .channels = 3, .values = noise.pictures[i]};
        bake::write_exr(fs::path(options.output) / (name + ".exr"), image);
        write_noise_sheet(fs::path(options.output) / (name + ".png"), pictures, width, crop);
    }
}

nlohmann::json json_of(const KindNoise& kind, std::uint32_t seeds) {
    return {{"pixels", kind.delta_e.size() / seeds},
            {"relative_rmse", kind.relative_rmse()},
            {"mean_delta_e", kind.mean_delta_e()},
            {"delta_e_95", kind.delta_e_quantile(0.95)}};
}

void print_kind(const std::string& scene,
                const std::string& light,
                std::size_t kind,
                const KindNoise& noise,
                std::uint32_t seeds) {
    if (!noise.delta_e.empty()) {
        fmt::print("| {} | {} | {} | {} | {:.2f} % | {:.2f} | {:.2f} |\n", scene, light,
                   kNoiseKindNames[kind], noise.delta_e.size() / seeds,
                   100 * noise.relative_rmse(), noise.mean_delta_e(),
                   noise.delta_e_quantile(0.95));
    }
}

// Of maps and of the bare sun, over all scenes: every picture counts alike.
struct Overall {
    struct Kind {
        double squared = 0;
        double delta_e = 0;
        std::uint32_t pictures = 0;
    };
    std::array<Kind, kNoiseKinds> kinds;

    void add(const BakeNoise& noise) {
        for (std::size_t kind = 0; kind < noise.size(); ++kind) {
            if (!noise[kind].delta_e.empty()) {
                kinds[kind].squared +=
                    noise[kind].relative_rmse() * noise[kind].relative_rmse();
                kinds[kind].delta_e += noise[kind].mean_delta_e();
                ++kinds[kind].pictures;
            }
        }
    }
    nlohmann::json print(const std::string& lights) const {
        nlohmann::json object;
        for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
            const auto count = static_cast<double>(std::max(1U, kinds[kind].pictures));
            const double rmse = std::sqrt(kinds[kind].squared / count);
            const double delta_e = kinds[kind].delta_e / count;
            fmt::print("| all | {} | {} | | {:.2f} % | {:.2f} | |\n", lights,
                       kNoiseKindNames[kind], 100 * rmse, delta_e);
            object[std::string(kNoiseKindNames[kind])] = {{"relative_rmse", rmse},
                                                          {"mean_delta_e", delta_e}};
        }
        return object;
    }
};

// As Markdown, so that it can stand in a README.
int run(const Options& options) {
    catch_interruption();
    const std::uint32_t n = options.reference.face_resolution;
    const std::size_t maps = options.environments.size();
    std::vector<ReferenceLight> lights =
        environment_lights(options.environments, options.yaw_degrees, n);
    for (ReferenceLight& light : model_lights(n)) {
        lights.push_back(std::move(light));
    }
    bake::BakeParameters parameters = options.bake;
    parameters.width = options.reference.width;
    parameters.height = options.reference.height;
    parameters.face_resolution = n;
    parameters.bounces = options.reference.bounces;
    bake::check_parameters(parameters);
    check_crop(options);
    fs::create_directories(options.output);
    nlohmann::json report{{"parameters", bake::json_from_parameters(parameters)},
                          {"scenes", nlohmann::json::object()}};
    Overall under_maps;
    Overall under_sun;
    std::string costs =
        "| scene | rays of visibility | of paths | processor |\n|---|---|---|---|\n";
    std::string stated = "| scene | light | stated | true |\n|---|---|---|---|\n";
    fmt::print(
        "| scene | light | pixels | number | relative RMSE | mean ΔE | 95 % |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const std::string& name : options.scenes) {
        if (is_interrupted()) {
            return kInterrupted;
        }
        const scene::Scene scene = scene::build_builtin_scene(name);
        const BakeReference reference = reference_of(scene, lights, options);
        const SceneNoise noise =
            measure_noise(scene, lights, reference, parameters, options.seeds,
                          fs::path(options.output) / (name + ".relume"));
        nlohmann::json& entry = report["scenes"][name];
        for (std::size_t i = 0; i < maps; ++i) {
            for (std::size_t kind = 0; kind < kNoiseKinds; ++kind) {
                print_kind(name, lights[i].name, kind, noise.lit[i][kind], options.seeds);
                entry["lights"][lights[i].name][std::string(kNoiseKindNames[kind])] =
                    json_of(noise.lit[i][kind], options.seeds);
            }
            (lights[i].name == "bare-sun" ? under_sun : under_maps).add(noise.lit[i]);
        }
        const double natural = noise.relative_l2(maps, kModelLights);
        const double sun = noise.relative_l2(maps + kModelLights, kModelLights);
        stated += fmt::format(
            "| {0} | natural | {1:.2f} % | {2:.2f} % |\n"
            "| {0} | sun | {3:.2f} % | {4:.2f} % |\n",
            name, 100 * noise.stated_natural, 100 * natural, 100 * noise.stated_sun, 100 * sun);
        costs +=
            fmt::format("| {} | {:.2f} M | {:.2f} M | {:.2f} s |\n", name,
                        noise.visibility_rays / 1e6, noise.path_rays / 1e6, noise.cpu_seconds);
        entry["stated"] = {{"natural", noise.stated_natural}, {"sun", noise.stated_sun}};
        entry["true"] = {{"natural", natural}, {"sun", sun}};
        entry["visibility_rays"] = noise.visibility_rays;
        entry["path_rays"] = noise.path_rays;
        entry["cpu_seconds"] = noise.cpu_seconds;
        write_pictures(name, reference, noise, options);
        std::fflush(stdout);
    }
    report["maps"] = under_maps.print("maps");
    report["bare_sun"] = under_sun.print("bare-sun");
    fmt::print("\n{}\n{}", costs, stated);
    const std::string text = report.dump(2) + "\n";
    files::write_file_atomically(fs::path(options.output) / "bake-noise.json",
                                 {files::bytes_of(text)});
    return 0;
}

}  // namespace

Command add_bake_noise_command(CLI::App& program) {
    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand(
        "bake-noise",
        "distance of baked pictures from a reference, by kind of pixel, and cost");
    const auto add = [command](const char* name, auto& value, const char* text) {
        return command->add_option(name, value, text)->capture_default_str();
    };
    add("--scenes", options->scenes, "built-in scenes")->delimiter(',');
    add("--environments", options->environments, "names or files")->delimiter(',');
    add("--yaw", options->yaw_degrees, "degrees by which they are turned");
    add("--seeds", options->seeds, "bakes of each scene")->check(CLI::Range(1, 100));
    add("--width", options->reference.width, "pixels");
    add("--height", options->reference.height, "pixels");
    add("--light-resolution", options->reference.face_resolution, "n");
    add("--bounces", options->reference.bounces, "after the first surface");
    add("--reference-side", options->reference.side,
        "the reference's camera positions along a pixel, twice, with a ray to each texel each")
        ->check(CLI::Range(1, 64));
    add("--reference-edge-side", options->reference.edge_side, "the same where surfaces meet")
        ->check(CLI::Range(1, 64));
    add("--reference-paths", options->reference.paths, "paths a pixel, twice")
        ->check(CLI::Range(1, 1 << 16));
    add("--samples", options->bake.samples, "of the bake, as of relume-bake");
    add("--pixel-samples", options->bake.pixel_samples, "the same");
    add("--edge-samples", options->bake.edge_samples, "the same");
    add("--pool-radius", options->bake.pool_radius, "the same");
    add("--shrinkage", options->bake.shrinkage, "the same");
    add("--bits", options->bake.bits, "the same");
    add("--cache", options->cache, "folder of references");
    add("-o,--output", options->output, "folder for JSON and pictures");
    add("--before", options->before, "an earlier run's folder, to show its pictures beside");
    add("--crop", options->crop, "left,top,width,height of what is shown")
        ->delimiter(',')
        ->expected(4);
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
