#include "client/cli/client_error.h"
#include "client/cli/commands.h"
#include "client/cli/edit_options.h"
#include "client/cli/environment_upload.h"
#include "client/cli/image_file.h"
#include "client/cli/server_names.h"
#include "client/cli/settled_image.h"
#include "protocol/base/program/usage.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

namespace relume::cli {
namespace {

struct RenderOptions {
    ServerOptions server;
    std::string scene;
    std::string room;
    std::string environment;
    MapReading map;
    EditOptions edits;
    bool until_exact = false;
    std::optional<double> until_error;
    double timeout_seconds = 120;
    std::string output;
    bool json = false;
};

nlohmann::json summary_of(const SettledImage& settled,
                          const std::string& room,
                          double seconds) {
    const wire::ImageHeader& header = settled.header;
    return {{"scene", settled.scene.name},
            {"room", room},
            {"width", header.width},
            {"height", header.height},
            {"revision", header.revision},
            {"sequence", header.sequence},
            {"relative_error", header.relative_error},
            {"exact", header.exact},
            {"edit_to_image_ms", settled.edit_to_image_ms
                                     ? nlohmann::json(*settled.edit_to_image_ms)
                                     : nlohmann::json()},
            {"server_edit_to_image_ms", header.edit_to_image_ms},
            {"relight_ms", header.relight_ms},
            {"encode_ms", header.encode_ms},
            {"coefficients_applied", header.coefficients_applied},
            {"coefficients_remaining", header.coefficients_remaining},
            {"bytes", header.payload_bytes},
            {"seconds", seconds},
            {"state", wire::to_json(settled.state)}};
}

void render(const RenderOptions& options) {
    const Clock::time_point begin = Clock::now();
    static_cast<void>(image_format_from_path(options.output));
    require_writable(options.output);
    const Url server = url_from_text(options.server.url);
    const bool is_private = options.room.empty();
    if (is_private && options.scene.empty()) {
        throw program::UsageError(
            "render: found neither --scene nor --room, expected one of them");
    }
    if (!options.scene.empty()) {
        require_scene(server, options.scene);
    }
    const std::string environment =
        options.environment.empty() ? std::string()
                                    : environment_on_server(server, options.server.token,
                                                            options.environment, options.map);
    nlohmann::json patch = patch_from_options(options.edits, environment);
    if (!options.scene.empty() && patch.contains("materials")) {
        require_materials(server, options.scene, patch["materials"]);
    }
    // A room settles where its target error lets it. One that is not ours stays as it is unless
    // it is edited anyway.
    if (is_private || !patch.empty()) {
        patch["budget"]["target_error"] = options.until_error.value_or(0);
    }
    const SettledImageRequest request{
        .connection = {.server = server,
                       .room = is_private ? random_room_name("render") : options.room,
                       .scene = options.scene,
                       .images = ImageChoice::settled,
                       .token = options.server.token},
        .patch = std::move(patch),
        .until_error = options.until_error,
        .timeout = std::chrono::milliseconds(
            static_cast<std::int64_t>(options.timeout_seconds * 1000))};
    const SettledImage settled = fetch_settled_image(request);
    write_image_file(options.output, settled.image, settled.header, settled.state.display);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (options.json) {
        fmt::print("{}\n", summary_of(settled, request.connection.room, seconds).dump());
    } else {
        spdlog::info("{}: {}×{}, {} after {:.2f} s", options.output, settled.header.width,
                     settled.header.height,
                     settled.header.exact
                         ? std::string("exact")
                         : fmt::format("stated error {:.3g}", settled.header.relative_error),
                     seconds);
    }
}

void add_camera_options(CLI::App& command, EditOptions& edits) {
    command.add_option("--eye", edits.eye,
                       "X,Y,Z where the camera stands, in the world, where the scene lets it "
                       "move");
    command.add_option("--look-at", edits.look_at, "X,Y,Z in the middle of the image");
    command.add_option("--up", edits.up, "X,Y,Z that points upwards in the image");
    command.add_option("--fov", edits.fov_degrees,
                       "degrees between the image's lower and upper edge");
    command.add_option("--size", edits.size, "WIDTHxHEIGHT of the image, in pixels");
}

void add_material_options(CLI::App& command, MaterialOptions& materials) {
    command
        .add_option("--curve", materials.curves,
                    "MATERIAL=JSON or MATERIAL=@FILE: the curve of a material, as 256 samples "
                    "or an object such as {\"shape\":\"ggx\",\"roughness\":0.1}; may be "
                    "given several times")
        ->take_all();
    command
        .add_option("--diffuse", materials.diffuses,
                    "MATERIAL=R,G,B times the material's diffuse colour as baked")
        ->take_all();
    command.add_option("--tint", materials.tints, "MATERIAL=R,G,B times the material's curve")
        ->take_all();
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = app.add_subcommand(
        "render", "Relight a scene, wait until the image is good enough, and save it.");
    add_server_options(*command, options->server);
    command->add_option("--scene", options->scene, "scene name on the server");
    command->add_option("--room", options->room,
                        "room to join (default: a new one that nobody else sees)");
    command->add_option("--environment", options->environment,
                        "environment: a file to upload (.hdr, .exr) or a name on the server");
    add_map_options(*command, options->map);
    command->add_option("--rotate", options->edits.rotate, "YAW,PITCH,ROLL in degrees");
    command
        ->add_option("--light", options->edits.lights,
                     "round light ID:X,Y,Z:RADIUS_DEGREES:R,G,B; may be given several times")
        ->take_all();
    add_camera_options(*command, options->edits);
    add_material_options(*command, options->edits.materials);
    command
        ->add_option(
            "--finish", options->edits.finishes,
            "PART=MATERIAL[@NUMBER][:R,G,B for each lobe]: a part of the scene is given "
            "a material of the server, such as floor=phong@64:1,0.8,0.5; may be given "
            "several times")
        ->take_all();
    command->add_option(
        "--patch", options->edits.patch,
        "lighting as a JSON merge patch, or @FILE with one, as the page exports "
        "it; the other options are applied over it");
    command->add_option("--method", options->edits.method, "nwa, bi, pbi or guarded");
    command->add_option("--priority", options->edits.priority,
                        "area, none, transport or benefit");
    auto* milliseconds =
        command->add_option("--budget-ms", options->edits.budget_ms,
                            "milliseconds of an image, from edit to encoded picture");
    command->add_option("--coefficients", options->edits.coefficients, "coefficients per image")
        ->excludes(milliseconds);
    auto* exact = command->add_flag("--until-exact", options->until_exact,
                                    "wait for exact (the default)");
    command
        ->add_option("--until-error", options->until_error,
                     "wait for a stated relative L2 error of at most this")
        ->check(CLI::Range(0.0, 1.0))
        ->excludes(exact);
    command->add_option("--timeout", options->timeout_seconds, "seconds to wait for the image")
        ->check(CLI::Range(0.001, 86400.0))
        ->capture_default_str();
    command
        ->add_option("-o,--output", options->output,
                     ".exr, .hdr (linear) or .png, .jpg (display-referred)")
        ->required();
    command->add_flag("--json", options->json, "print one JSON line about the image");
    command->callback([options] { render(*options); });
}

}  // namespace relume::cli
