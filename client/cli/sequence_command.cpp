#include "client/cli/client_error.h"
#include "client/cli/commands.h"
#include "client/cli/edit_options.h"
#include "client/cli/environment_upload.h"
#include "client/cli/image_file.h"
#include "client/cli/progress.h"
#include "client/cli/sequence_player.h"
#include "client/cli/server_names.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/usage.h"
#include "protocol/wire/room_patch.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace relume::cli {
namespace {

struct SequenceCommandOptions {
    ServerOptions server;
    std::string script;
    std::string scene;
    std::string room;
    std::string environment;
    MapReading map;
    std::string folder;
    std::optional<ImageFiles> files;
    double rate_hz = 30;
    std::string csv;
    std::string json;
    std::string patch;
    bool progress = false;
};

SequenceScript script_from_file(const std::string& path) {
    try {
        return sequence_script_from_text(files::read_regular_file(path, kMaxScriptBytes));
    } catch (const files::FileError& error) {
        throw ClientError(error.what());
    } catch (const ClientError& error) {
        throw ClientError(path + ": " + error.what());
    }
}

void play(const SequenceCommandOptions& options) {
    SequenceOptions sequence;
    sequence.script = script_from_file(options.script);
    const Url server = url_from_text(options.server.url);
    sequence.script.start =
        wire::merge_patches(sequence.script.start, patch_from_text(options.patch));
    if (!options.environment.empty()) {
        sequence.script.start["environment"]["name"] = environment_on_server(
            server, options.server.token, options.environment, options.map);
    }
    sequence.connection = {
        .server = server,
        .room = options.room.empty() ? random_room_name("sequence") : options.room,
        .scene = options.scene.empty() ? sequence.script.scene : options.scene,
        .images = ImageChoice::all,
        .token = options.server.token};
    if (options.room.empty() && sequence.connection.scene.empty()) {
        throw program::UsageError(
            "sequence: found no scene, expected one in the script or by --scene");
    }
    sequence.rate_hz = options.rate_hz;
    sequence.files =
        options.folder.empty() ? ImageFiles::none : options.files.value_or(ImageFiles::jpeg);
    sequence.folder = options.folder;
    if (options.folder.empty() &&
        options.files.value_or(ImageFiles::none) != ImageFiles::none) {
        throw program::UsageError("sequence: found --images without a folder, expected -o");
    }
    if (!options.folder.empty()) {
        std::filesystem::create_directories(options.folder);
    }
    for (const std::string& file : {options.csv, options.json}) {
        if (!file.empty()) {
            require_writable(file);
        }
    }
    if (!sequence.connection.scene.empty()) {
        require_scene(server, sequence.connection.scene);
    }
    const SequenceReport report = [&] {
        Progress progress(options.progress);
        sequence.on_progress = [&progress](const SequenceProgress& at) {
            progress.update(fmt::format("step {} of {}, {} edits, {} images, error {:.3g}",
                                        std::min(at.step + 1, at.steps), at.steps, at.edits,
                                        at.images, at.relative_error));
        };
        return play_sequence(sequence);
    }();
    if (!options.csv.empty()) {
        write_file(options.csv, csv_from_report(report));
    }
    if (!options.json.empty()) {
        write_file(options.json, json_from_report(report).dump(2) + '\n');
    }
    fmt::print("{}\n", summary_from_report(report).dump());
}

}  // namespace

void add_sequence_command(CLI::App& app) {
    auto options = std::make_shared<SequenceCommandOptions>();
    CLI::App* command = app.add_subcommand(
        "sequence", "Play a script of edits in real time; record images, errors and timings.");
    add_server_options(*command, options->server);
    command->add_option("script", options->script, "script, a JSON file")->required();
    command->add_option("--scene", options->scene, "scene name (default: the script's)");
    command->add_option("--room", options->room,
                        "room to join (default: a new one that nobody else sees)");
    command->add_option("--environment", options->environment,
                        "environment to start with: a file to upload or a name on the server");
    add_map_options(*command, options->map);
    command->add_option("-o,--output", options->folder, "folder for the images");
    command
        ->add_option("--images", options->files,
                     "none, jpeg, png, or exr for the linear ones (default: jpeg with -o)")
        ->transform(CLI::CheckedTransformer(
            std::map<std::string, ImageFiles>{{"none", ImageFiles::none},
                                              {"jpeg", ImageFiles::jpeg},
                                              {"png", ImageFiles::png},
                                              {"exr", ImageFiles::exr}}));
    command->add_option("--rate", options->rate_hz, "edits per second while something moves")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command->add_option(
        "--patch", options->patch,
        "lighting to start with as a JSON merge patch, or @FILE with one, as the "
        "page exports it; applied over the script's start");
    command->add_flag("--progress", options->progress,
                      "say how far it is, also where standard error is no terminal");
    command->add_option("--csv", options->csv, "file for a table, one line per image");
    command->add_option("--json", options->json, "file for the same as JSON");
    command->callback([options] { play(*options); });
}

}  // namespace relume::cli
