#include "client/cli/client_error.h"
#include "client/cli/commands.h"
#include "client/cli/edit_options.h"
#include "client/cli/load_test.h"
#include "client/cli/progress.h"
#include "client/cli/server_names.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relume::cli {
namespace {

struct LoadCommandOptions {
    ServerOptions server;
    LoadOptions load;
    std::string patch;
    bool progress = false;
};

void test_load(const LoadCommandOptions& options) {
    LoadOptions load = options.load;
    load.server = url_from_text(options.server.url);
    load.token = options.server.token;
    load.patch = patch_from_text(options.patch);
    require_scene(load.server, load.scene);
    load.materials = offered_materials(load.server);
    const nlohmann::json result = [&] {
        Progress progress(options.progress);
        if (!progress.is_silent()) {
            load.on_progress = [&progress](const LoadProgress& at) {
                progress.update(fmt::format("{} of {} connections shown, {} edits, {} images",
                                            at.shown, at.connections, at.edits, at.images));
            };
        }
        return run_load_test(load);
    }();
    fmt::print("{}\n", result.dump());
    if (!result.at("ok").get<bool>()) {
        throw ClientError(
            fmt::format("load: found errors {} and ended connections {}, expected none",
                        result.at("errors").dump(), result.at("ends").dump()));
    }
}

}  // namespace

void add_load_command(CLI::App& app) {
    auto options = std::make_shared<LoadCommandOptions>();
    CLI::App* command = app.add_subcommand(
        "load", "Drag in many rooms at once; print latencies and throughput as JSON.");
    add_server_options(*command, options->server);
    LoadOptions& load = options->load;
    command->add_option("--scene", load.scene, "scene name on the server")->required();
    command->add_option("--sessions", load.dragging, "connections that drag")
        ->check(CLI::Range(std::size_t{0}, kMaxLoadConnections))
        ->capture_default_str();
    command->add_option("--idle", load.idle, "connections that only watch")
        ->check(CLI::Range(std::size_t{0}, kMaxLoadConnections))
        ->capture_default_str();
    command->add_option("--rate", load.rate_hz, "edits per second of each dragging connection")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command->add_option("--seconds", load.seconds, "how long to drag")
        ->check(CLI::Range(0.1, 86400.0))
        ->capture_default_str();
    command->add_option("--budget-ms", load.budget_ms, "milliseconds asked for each image")
        ->check(CLI::Range(0.1, 1000.0));
    command->add_option("--patch", options->patch,
                        "lighting that every dragging connection begins with, as a JSON merge "
                        "patch, or @FILE with one");
    command->add_flag("--progress", options->progress,
                      "say how far it is, also where standard error is no terminal");
    command->add_option("--threads", load.threads, "threads for all connections together")
        ->check(CLI::Range(std::size_t{1}, std::size_t{64}))
        ->capture_default_str();
    command->callback([options] { test_load(*options); });
}

}  // namespace relume::cli
