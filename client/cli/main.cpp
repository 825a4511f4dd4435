// relume: renders, plays scripts of edits and tests load against a running relume-server.
#include "client/cli/commands.h"
#include "protocol/base/program/program.h"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

int main(int argc, char** argv) {
    // Standard output is for results alone.
    spdlog::set_default_logger(spdlog::stderr_color_mt("relume"));
    spdlog::set_pattern("%n: %^%l%$: %v");

    CLI::App app("Client of relume-server: relights baked scenes from the command line.",
                 "relume");
    app.set_version_flag("--version", RELUME_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    relume::cli::add_render_command(app);
    relume::cli::add_sequence_command(app);
    relume::cli::add_listing_commands(app);
    relume::cli::add_load_command(app);
    // Commands run as callbacks of their subcommands.
    return relume::program::run_program(app, argc, argv, [] { return relume::program::kDone; });
}
