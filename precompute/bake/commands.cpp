#include "precompute/bake/commands.h"

#include "precompute/bake/bake.h"
#include "precompute/bake/base/error.h"
#include "precompute/bake/framing.h"
#include "precompute/bake/image_file.h"
#include "precompute/bake/inspect.h"
#include "precompute/bake/material_command.h"
#include "precompute/bake/output_directory.h"
#include "precompute/bake/progress_line.h"
#include "precompute/bake/relight.h"
#include "precompute/bake/report.h"
#include "precompute/bake/verdict.h"
#include "precompute/scene/builtin.h"
#include "precompute/scene/error.h"
#include "precompute/scene/import.h"
#include "protocol/base/program/usage.h"
#include "protocol/base/text/near_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>

namespace relume::bake {
namespace {

constexpr std::uint32_t kCurveLightResolution = 128;

std::atomic<bool> stop_requested = false;

void request_stop(int /*signal*/) {
    stop_requested = true;
}

bool is_finite(double value) {
    return std::isfinite(value);
}
bool is_finite(std::uint32_t /*value*/) {
    return true;
}

// `count` finite numbers with `separator` between them and nothing else.
template <typename T>
std::vector<T> parse_list(const char* option,
                          const std::string& text,
                          char separator,
                          std::size_t count,
                          const char* expected) {
    std::vector<T> values;
    const char* at = text.data();
    const char* end = at + text.size();
    while (values.size() < count) {
        T value{};
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || !is_finite(value)) {
            break;
        }
        values.push_back(value);
        at = next;
        if (values.size() < count && at != end && *at == separator) {
            ++at;
        }
    }
    if (values.size() != count || at != end) {
        throw program::UsageError(
            fmt::format("{} is '{}', expected {}", option, text, expected));
    }
    return values;
}

std::optional<Imath::V3d> parse_point(const char* option, const std::string& text) {
    if (text.empty()) {
        return std::nullopt;
    }
    const auto values = parse_list<double>(option, text, ',', 3, "three finite numbers X,Y,Z");
    return Imath::V3d(values[0], values[1], values[2]);
}

scene::ImportOptions import_options(const Arguments& arguments,
                                    const BakeParameters& parameters) {
    if (arguments.fov_degrees &&
        !(*arguments.fov_degrees > 0 && *arguments.fov_degrees < 180)) {
        throw program::UsageError(fmt::format(
            "--fov is {}, expected degrees above 0 and below 180", *arguments.fov_degrees));
    }
    scene::ImportOptions options;
    options.camera = {.wanted = arguments.camera,
                      .eye = parse_point("--eye", arguments.eye),
                      .look_at = parse_point("--look-at", arguments.look_at),
                      .up = parse_point("--up", arguments.up),
                      .vertical_fov_degrees = arguments.fov_degrees};
    options.aspect = static_cast<double>(parameters.width) / parameters.height;
    options.up_axis = parameters.up_axis;
    return options;
}

scene::Scene builtin_scene(const std::string& name) {
    try {
        return scene::build_builtin_scene(name);
    } catch (const scene::SceneError& fault) {
        if (fault.fault() == scene::SceneFault::unknown_name) {
            throw program::UsageError(fault.what());
        }
        throw;
    }
}

scene::Scene scene_of(const Arguments& arguments, const BakeParameters& parameters) {
    const scene::ImportOptions options = import_options(arguments, parameters);
    if (arguments.builtin.empty()) {
        return scene::import_scene(arguments.scene, options);
    }
    if (parameters.up_axis != scene::UpAxis::y) {
        throw program::UsageError(
            "--up-axis is for scene files: in scenes made by code +Y is up");
    }
    scene::Scene scene = builtin_scene(arguments.builtin);
    scene.camera = scene::placed_as_asked(options.camera, scene.camera);
    return scene;
}

int run_list_cameras(const Arguments& arguments) {
    if (arguments.scene.empty()) {
        throw program::UsageError(
            "--list-cameras is for scene files: a scene made by code has one camera");
    }
    const auto cameras = scene::cameras_in(arguments.scene);
    for (const std::string& line : scene::list_of(cameras)) {
        fmt::print("{}\n", line);
    }
    if (cameras.empty()) {
        fmt::print("no camera: one that frames the scene is used\n");
    }
    return 0;
}

void print_notes(const scene::ImportReport& report) {
    for (const std::string& unused : report.unused) {
        std::fprintf(stderr, "relume-bake: not used: %s\n", unused.c_str());
    }
    for (const std::string& repair : report.repairs) {
        std::fprintf(stderr, "relume-bake: repaired: %s\n", repair.c_str());
    }
}

// Terms and curves have different ways to be found, and one option that names them.
template <typename NameTable>
auto factors_from_option(const std::string& word, const NameTable& names, const char* whose) {
    const auto method = word.empty() ? names.value(names.words().front()) : names.value(word);
    if (!method) {
        throw program::UsageError(fmt::format("--factors is '{}', expected for {} {}", word,
                                              whose, names.alternatives()));
    }
    return *method;
}

// None where the bake is of light.
std::optional<CurveEdits> curve_edits(const Arguments& arguments,
                                      const scene::Scene& scene,
                                      const BakeParameters& parameters,
                                      std::span<const MeasuredBrdf> measured) {
    if (arguments.curves.edits.empty()) {
        return std::nullopt;
    }
    CurveRequest request = arguments.curves;
    request.factors =
        factors_from_option(arguments.factors, factors::kCurveMethodNames, "curves");
    std::vector<EditedMaterial> materials = edited_materials(scene, request, measured);
    LightRequest light = arguments.frozen_light;
    if (!arguments.rotate.empty()) {
        const auto degrees = parse_list<double>("--rotate", arguments.rotate, ',', 3,
                                                "three numbers YAW,PITCH,ROLL in degrees");
        light.rotation_degrees = {degrees[0], degrees[1], degrees[2]};
    }
    return CurveEdits{.light = frozen_light(light, parameters.face_resolution),
                      .materials = std::move(materials)};
}

// What is said of curves without --edit, and of light in its place, has no meaning.
void check_curve_options(const Arguments& arguments) {
    if (!arguments.curves.edits.empty() && !arguments.fields.empty()) {
        throw program::UsageError(
            "--edit freezes the light that --editable leaves free, expected one of them");
    }
    if (arguments.curves.edits.empty()) {
        const bool says_curves = !arguments.curves.models.empty() ||
                                 !arguments.frozen_light.environment.empty() ||
                                 !arguments.frozen_light.centre.empty() ||
                                 !arguments.rotate.empty() || arguments.frozen_light.gain != 1;
        if (says_curves) {
            throw program::UsageError(
                "--model, --environment, --centre, --rotate and --gain are for "
                "bakes "
                "of curves, expected --edit MATERIAL beside them");
        }
    } else if (arguments.frozen_light.environment.empty()) {
        throw program::UsageError(
            "--edit bakes curves under a light that stays, expected --environment FILE, or a "
            "name such as sky-noon, beside it");
    }
}

int run_bake(const Arguments& arguments) {
    if (arguments.scene.empty() == arguments.builtin.empty()) {
        throw program::UsageError(
            "expected a scene file or --builtin NAME; see relume-bake --help");
    }
    if (arguments.list_cameras) {
        return run_list_cameras(arguments);
    }
    if (arguments.output.empty() && arguments.preview.empty()) {
        throw program::UsageError("expected -o NAME.relume; see relume-bake --help");
    }
    BakeParameters parameters = arguments.parameters;
    if (!arguments.size.empty()) {
        const auto size = parse_list<std::uint32_t>("--size", arguments.size, 'x', 2,
                                                    "two whole numbers WxH");
        parameters.width = size[0];
        parameters.height = size[1];
    }
    if (arguments.light_resolution) {
        parameters.face_resolution = *arguments.light_resolution;
    } else if (!arguments.curves.edits.empty()) {
        parameters.face_resolution = kCurveLightResolution;
    }
    if (arguments.order) {
        if (parameters.basis != basis::CubemapBasis::Kind::spherical_harmonics) {
            throw program::UsageError(
                fmt::format("--order is {}: wavelets have none, expected --basis sh beside it",
                            *arguments.order));
        }
        parameters.order = *arguments.order;
    }
    if (arguments.curves.edits.empty()) {
        parameters.factor_method =
            factors_from_option(arguments.factors, factors::kMethodNames, "terms");
    }
    check_parameters(parameters);
    check_fields(arguments.fields, parameters);
    std::vector<MeasuredBrdf> measured;
    for (const std::string& words : arguments.measured) {
        measured.push_back(read_measured_brdf(words));
    }
    check_curve_options(arguments);
    if (!arguments.preview.empty()) {
        const scene::Scene scene = scene_of(arguments, parameters);
        print_notes(scene.report);
        write_preview(arguments.preview, scene, parameters);
        return 0;
    }
    const OutputDirectory output(transport_directory_from_option(arguments.output), parameters,
                                 arguments.fields);
    if (output.path() != std::filesystem::path(arguments.output)) {
        std::fprintf(stderr, "relume-bake: -o %s is completed to %s\n",
                     arguments.output.c_str(), output.path().c_str());
    }
    const scene::Scene scene = scene_of(arguments, parameters);
    print_notes(scene.report);
    const std::optional<CurveEdits> edits = curve_edits(arguments, scene, parameters, measured);
    std::signal(SIGINT, request_stop);
    std::signal(SIGTERM, request_stop);
    BakeSummary summary;
    {
        ProgressLine line(stderr);
        const BakeHooks hooks{
            .on_note =
                [](const std::string& note) {
                    std::fprintf(stderr, "relume-bake: %s\n", note.c_str());
                },
            .on_progress = [&](const BakeProgress& progress) { line.update(progress); },
            .should_stop = [] { return stop_requested.load(); }};
        summary =
            edits ? bake_curves(scene, parameters, *edits, output.path(), hooks, measured)
                  : bake(scene, parameters, output.path(), hooks, measured, arguments.fields);
    }
    write_report(output.path(), report_from(scene, parameters, summary));
    const nlohmann::json description = describe(output.path());
    std::fputs(text_from_description(description).c_str(), stdout);
    std::fputs(verdict(scene.report, description, output.path()).c_str(), stdout);
    return 0;
}

// Of info, verify and relight.
std::filesystem::path existing_directory(const Arguments& arguments) {
    if (!std::filesystem::exists(arguments.directory)) {
        throw BakeError(fmt::format("{}: {}", arguments.directory,
                                    text::text_from_missing_file(arguments.directory)));
    }
    return arguments.directory;
}

int run_info(const Arguments& arguments) {
    const std::filesystem::path path = existing_directory(arguments);
    const bool is_material = is_material_file(path);
    const nlohmann::json description = is_material ? describe_material(path) : describe(path);
    const std::string text =
        arguments.json
            ? description.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
        : is_material ? text_from_material(description)
                      : text_from_description(description);
    std::fputs(text.c_str(), stdout);
    return 0;
}

int run_verify(const Arguments& arguments) {
    const std::filesystem::path path = existing_directory(arguments);
    if (is_material_file(path)) {
        (void)describe_material(path);
        std::printf("%s: the checksum and every entry are right\n", path.c_str());
        return 0;
    }
    const std::vector<std::string> faults = find_faults(path);
    for (const std::string& fault : faults) {
        std::fprintf(stderr, "relume-bake: %s\n", fault.c_str());
    }
    if (faults.empty()) {
        std::printf("%s: every checksum and every cell is right\n",
                    arguments.directory.c_str());
    }
    return faults.empty() ? 0 : 1;
}

int run_relight(const Arguments& arguments) {
    if (!arguments.image.ends_with(".exr")) {
        throw program::UsageError(fmt::format(
            "-o {}: found another ending, expected an EXR image, NAME.exr", arguments.image));
    }
    const auto transport = transport::Transport::open(existing_directory(arguments));
    const transport::Manifest& manifest = transport->manifest();
    if (!manifest.signal_basis.is_of_light()) {
        throw BakeError(
            fmt::format("{}: is of kind curves, whose light is frozen, expected a "
                        "transport of light",
                        arguments.directory));
    }
    const std::uint32_t n = manifest.signal_basis.cubemap().face_resolution();
    const DenseImage relit = relight(*transport, read_cubemap_strip(arguments.light, n));
    FloatImage image{relit.width, relit.height, 4, {}};
    for (std::uint32_t y = 0; y < relit.height; ++y) {
        for (std::uint32_t x = 0; x < relit.width; ++x) {
            for (const auto& plane : relit.rgb) {
                image.values.push_back(
                    static_cast<float>(plane[std::size_t{y} * relit.width + x]));
            }
            image.values.push_back(relit.coverage[std::size_t{y} * relit.width + x]);
        }
    }
    write_exr(arguments.image, image);
    return 0;
}

int run_list() {
    for (const scene::BuiltinScene& scene : scene::builtin_scenes()) {
        fmt::print("{:10} {}\n", scene.name, scene.description);
    }
    return 0;
}

}  // namespace

int run_command(const CLI::App& app, const Arguments& arguments) {
    if (app.got_subcommand("material")) {
        return run_material_command(arguments.material);
    }
    if (app.got_subcommand("info")) {
        return run_info(arguments);
    }
    if (app.got_subcommand("verify")) {
        return run_verify(arguments);
    }
    if (app.got_subcommand("relight")) {
        return run_relight(arguments);
    }
    if (app.got_subcommand("list")) {
        return run_list();
    }
    return run_bake(arguments);
}

}  // namespace relume::bake
