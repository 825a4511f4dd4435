// How a server is to run: flags, then environment variables, then a configuration file.
#pragma once

#include "protocol/wire/limits.h"
#include "server/net/library/environment_library.h"
#include "server/net/rooms/rooms.h"
#include "server/net/sockets/connection_options.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace relume::net {

struct Configuration {
    std::filesystem::path scenes = "scenes";
    std::chrono::milliseconds scenes_interval{1000};  // between two looks at their folder
    std::filesystem::path environments;               // empty: the procedural ones alone
    std::filesystem::path materials;                  // empty: none
    light::MapCentre centre = light::MapCentre::negative_z;  // of the maps in that folder
    std::filesystem::path web_root;                          // empty: no page
    std::filesystem::path decoder;  // relume-decode; empty: beside the running program
    std::string listen = "127.0.0.1:8080";
    std::filesystem::path port_file;
    std::string token;
    std::vector<std::string> allow_origins;
    std::vector<std::string> allow_hosts;
    std::vector<std::string> trusted_proxies;
    std::size_t io_threads = 2;
    std::size_t workers = 2;  // rooms relit at once
    std::size_t threads = 0;  // of the relighting within; 0: one per core
    std::string log_level = "info";
    std::size_t drain_milliseconds = 5000;
    wire::Limits limits;
    ConnectionOptions connection;
    EnvironmentBounds environment_bounds;
    std::size_t material_cache_bytes = std::size_t{1} << 30;  // in texels, though unused
    RoomsOptions rooms;
};

// What a command line asks for.
enum class Request { serve, check_configuration };

struct CommandLine {
    Request request = Request::serve;
    Configuration configuration;
};

// Ends the program: --help and --version (code 0, `what` on standard output), or a mistake
// (code 2, on standard error) naming the option, what was found and what was expected.
class CommandLineExit : public std::runtime_error {
  public:
    CommandLineExit(int code, const std::string& text)
        : std::runtime_error(text), code_(code) {}
    [[nodiscard]] int code() const { return code_; }

  private:
    int code_;
};

// Option --some-name is also RELUME_SOME_NAME in the environment and some-name in the file that
// --config (or RELUME_CONFIG) names. Throws CommandLineExit.
[[nodiscard]] CommandLine parse_command_line(std::span<const char* const> arguments);

}  // namespace relume::net
