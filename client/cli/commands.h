// The subcommands of `relume`. Each adds its options to `app` and runs when it is chosen;
// failures leave it as exceptions.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace relume::cli {

inline constexpr const char* kDefaultServer = "http://127.0.0.1:8080";

void add_render_command(CLI::App& app);
void add_sequence_command(CLI::App& app);
void add_listing_commands(CLI::App& app);  // scenes, environments, info
void add_load_command(CLI::App& app);

// --server and --token, which every command has, with their environment variables.
struct ServerOptions {
    std::string url = kDefaultServer;
    std::string token;
};
void add_server_options(CLI::App& command, ServerOptions& options);

}  // namespace relume::cli
