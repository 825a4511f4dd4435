#include "server/net/configuration.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/program/program.h"
#include "protocol/base/text/near_names.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <optional>
#include <sstream>

namespace relume::net {

namespace {

constexpr const char* kVersion = "relume-server 0.1.0";
// Debian's blender-data brings eight CC0 maps.
constexpr const char* kStudioLights = "/usr/share/blender/datafiles/studiolights/world";
constexpr std::size_t kMaxConfigurationBytes = std::size_t{1} << 20;

std::string variable_of(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) {
        return c == '-' ? '_' : static_cast<char>(std::toupper(c));
    });
    return "RELUME_" + name;
}

// Adds options that have a flag, a variable and a key of one name.
class OptionSet {
  public:
    explicit OptionSet(CLI::App& app) : app_(app) {}

    template <typename T>
    CLI::Option* add(const std::string& name, T& value, const std::string& help) {
        return app_.add_option("--" + name, value, help)
            ->envname(variable_of(name))
            ->capture_default_str();
    }

    // A whole number of at least `least`.
    template <typename T>
    void add_count(const std::string& name,
                   T& value,
                   const std::string& help,
                   std::uint64_t least,
                   std::uint64_t most) {
        add(name, value, help)->check(CLI::Range(least, most));
    }

    // One of a few names, by what makes a value of a name and a name of a value.
    template <typename T, typename FromName, typename ToName>
    void add_choice(const std::string& name,
                    T& value,
                    const std::string& help,
                    FromName from_name,
                    ToName to_name,
                    const std::string& expected) {
        app_.add_option_function<std::string>(
                "--" + name,
                [&value, from_name, name, expected](const std::string& text) {
                    const std::optional<T> chosen = from_name(text);
                    if (!chosen) {
                        throw CLI::ValidationError("--" + name,
                                                   "found " + text + ", expected " + expected);
                    }
                    value = *chosen;
                },
                help)
            ->envname(variable_of(name))
            ->default_str(std::string(to_name(value)));
    }

    void add_milliseconds(const std::string& name,
                          std::chrono::milliseconds& value,
                          const std::string& help) {
        app_.add_option_function<std::int64_t>(
                "--" + name,
                [&value](std::int64_t count) { value = std::chrono::milliseconds(count); },
                help)
            ->envname(variable_of(name))
            ->default_str(std::to_string(value.count()))
            ->check(CLI::Range(std::int64_t{0}, std::int64_t{86'400'000}));
    }

  private:
    CLI::App& app_;
};

void add_places(OptionSet& options, Configuration& c) {
    options.add("scenes", c.scenes, "Folder of NAME.relume directories")
        ->check(CLI::ExistingDirectory);
    options.add_milliseconds(
        "scenes-interval-ms", c.scenes_interval,
        "Between two looks for scenes, environments and materials that came, changed or "
        "went; 0 looks again on SIGHUP alone");
    options.add("environments", c.environments, "Folder of .hdr and .exr files")
        ->check(CLI::ExistingDirectory);
    options
        .add("materials", c.materials,
             "Folder of .material files that parts of scenes may be given")
        ->check(CLI::ExistingDirectory);
    options.add_choice(
        "centre", c.centre,
        "Where the centres of those maps look: -z, +z, +x, -x, +y or -y; +x for "
        "maps made for Blender or three.js",
        [](std::string_view text) { return light::map_centre_from_string(text); },
        [](light::MapCentre centre) { return light::to_string(centre); },
        std::string(light::map_centre_names()));
    options.add("web-root", c.web_root, "Folder of the built page")
        ->check(CLI::ExistingDirectory);
    options.add("decoder", c.decoder,
                "Program that decodes uploads; relume-decode beside this one by default");
    options.add("listen", c.listen, "HOST:PORT; port 0 takes a free one, and logs it");
    options.add("port-file", c.port_file, "File that gets the port once it is known");
}

void add_access(OptionSet& options, Configuration& c) {
    options.add("token", c.token, "Asked of who enters a room or uploads; none by default");
    options.add("allow-origin", c.allow_origins,
                "Origin besides the server's own whose pages may enter rooms; * for all");
    options.add("allow-host", c.allow_hosts,
                "Name besides the address listened on under which the server may be asked, as "
                "behind a proxy; * for all");
    options.add("trusted-proxy", c.trusted_proxies,
                "Address of a proxy whose X-Forwarded-For says whose request it is");
}

void add_running(OptionSet& options, Configuration& c) {
    options.add_count("io-threads", c.io_threads, "Threads that serve sockets", 1, 64);
    options.add_count("workers", c.workers, "Rooms relit and encoded at once", 1, 256);
    options.add_count("threads", c.threads,
                      "Threads of the relighting within; 0 for one per core", 0, 1024);
    options.add("log-level", c.log_level, "debug, info, warn or error")
        ->check(CLI::IsMember({"debug", "info", "warn", "error"}));
    options.add_count("drain-ms", c.drain_milliseconds, "Most time between SIGTERM and the end",
                      0, 3'600'000);
}

void add_rooms(OptionSet& options, Configuration& c) {
    RoomOptions& room = c.rooms.room;
    options.add("default-environment", c.rooms.environment, "What a new room begins with");
    options.add_milliseconds("room-linger-ms", c.rooms.linger,
                             "How long a room is kept that everybody left");
    options.add_milliseconds("settle-ms", room.settle_delay,
                             "A state unchanged for so long gets its bit-exact image");
    options.add_milliseconds("refinement-interval-ms", room.images.refinement_interval,
                             "Least time between two images that converge");
    options.add_milliseconds("slice-ceiling-ms", room.images.slice_ceiling,
                             "Longest that one room relights before another may");
    options.add_count("room-material-bytes", room.images.material_bytes,
                      "For materials of a room that are edited beside its light", 0,
                      std::uint64_t{1} << 40);
    options.add_count("moving-quality", room.images.moving_jpeg_quality,
                      "JPEG quality while the state changes", 1, 100);
    options.add_count("converging-quality", room.images.converging_jpeg_quality,
                      "JPEG quality while an image converges", 1, 100);
}

void add_limits(OptionSet& options, Configuration& c) {
    constexpr std::uint64_t kMany = 1'000'000;
    wire::Limits& limits = c.limits;
    options.add_count("max-message-bytes", limits.message_bytes, "Of one message from a client",
                      1024, std::uint64_t{16} << 20);
    options.add_count("messages-per-second", limits.messages_per_second, "From one client", 1,
                      kMany);
    options.add_count("message-burst", limits.message_burst, "Messages at once from one client",
                      1, kMany);
    options.add_count("max-lights", limits.lights_per_room, "Area lights in a room", 1, 4096);
    options.add_count("max-clients", limits.clients_per_room, "Clients in a room", 1, kMany);
    options.add_count("max-clients-per-address", c.rooms.room.clients_per_address,
                      "Clients in a room that come from one address", 1, kMany);
    options.add_count("max-rooms", limits.rooms, "Rooms", 1, kMany);
    options.add_count("max-rooms-per-address", c.rooms.rooms_per_address,
                      "Rooms made by clients of one address", 1, kMany);
    options.add_count("images-in-flight", limits.images_in_flight,
                      "Images sent to a client ahead of its acknowledgement", 1, 64);
    options.add_count("max-upload-bytes", limits.upload_bytes, "Of one uploaded file", 1024,
                      std::uint64_t{1} << 30);
    options.add_count("max-uploads", limits.uploads, "Uploaded environments kept", 1, kMany);
    options.add_count("max-errors", limits.errors_per_connection,
                      "Refused messages before a client is sent away", 1, kMany);
    options.add_count("max-image-pixels", limits.image_pixels,
                      "Pixels of an image whose size people choose", 1, wire::kMaxImagePixels);
    options.add_count("max-upload-texels", c.connection.upload_texels,
                      "Texels of one uploaded environment", 64, std::uint64_t{1} << 27);
    options.add_count("upload-memory-bytes", c.environment_bounds.upload_memory_bytes,
                      "All uploaded environments, decoded", 0, std::uint64_t{1} << 40);
    options.add_count("environment-cache-bytes", c.environment_bounds.cache_bytes,
                      "Decoded environments kept though unused", 0, std::uint64_t{1} << 40);
    options.add_count("material-cache-bytes", c.material_cache_bytes,
                      "Materials in texels kept though unused", 0, std::uint64_t{1} << 40);
}

void add_connections(OptionSet& options, Configuration& c) {
    ConnectionOptions& connection = c.connection;
    options.add_count("max-connections", connection.connections, "TCP connections", 1,
                      1'000'000);
    options.add_count("max-connections-per-address", connection.connections_per_address,
                      "Connections from one address", 1, 1'000'000);
    options.add_count("max-concurrent-uploads", connection.concurrent_uploads,
                      "Uploads read or decoded at once", 1, 1024);
    options.add_count("max-uploads-per-address", connection.uploads_per_address,
                      "Of those, from one address", 1, 1024);
    options.add_count("max-request-header-bytes", connection.request_header_bytes,
                      "Of one HTTP request", 1024, 60 * 1024);
    options.add_count("send-buffer-bytes", connection.send_buffer_bytes,
                      "Sent to a client and not yet received by it", 4096,
                      std::uint64_t{64} << 20);
    options.add_milliseconds("request-timeout-ms", connection.request_timeout,
                             "To wait for a request, and to read its header");
    options.add_milliseconds("body-timeout-ms", connection.body_timeout, "To read an upload");
    options.add_milliseconds("body-grace-ms", connection.body_grace,
                             "To read an upload, besides what its bytes have earned");
    options.add_count("min-body-bytes-per-second", connection.body_bytes_per_second,
                      "Of an upload, after that grace", 1, std::uint64_t{1} << 30);
    options.add_milliseconds("write-timeout-ms", connection.write_timeout,
                             "For one write, until a client counts as not reading");
    options.add_milliseconds("write-grace-ms", connection.write_grace,
                             "More, until its connection is cut");
    options.add_milliseconds("handshake-timeout-ms", connection.handshake_timeout,
                             "To open and to close a WebSocket");
    options.add_milliseconds("silence-timeout-ms", connection.silence_timeout,
                             "Without a sign of life from a WebSocket");
}

// Of a configuration file: options that are environment variables too.
std::vector<std::string> keys_of(const CLI::App& app) {
    std::vector<std::string> keys;
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_envname().empty()) {
            keys.push_back(option->get_lnames().front());
        }
    }
    return keys;
}

std::vector<CLI::ConfigItem> items_of_file(const std::filesystem::path& path) {
    try {
        std::istringstream text(files::read_regular_file(path, kMaxConfigurationBytes));
        return CLI::ConfigTOML().from_config(text);
    } catch (const files::FileError& failure) {
        throw CLI::FileError(std::string("--config: ") + failure.what());
    }
}

// Fills in what neither flags nor variables set. CLI11's own order puts the file before the
// variables.
void read_configuration_file(CLI::App& app, const std::filesystem::path& path) {
    for (const CLI::ConfigItem& item : items_of_file(path)) {
        if (item.name == "++" || item.name == "--") {
            continue;  // marks of sections
        }
        CLI::Option* const option = app.get_option_no_throw("--" + item.name);
        if (option == nullptr || !item.parents.empty() || option->get_envname().empty()) {
            throw CLI::ConfigError(path.string() + ": unknown key " + item.fullname() +
                                   "; expected " +
                                   text::expected_name(item.name, keys_of(app), "keys"));
        }
        if (option->count() == 0) {
            option->add_result(item.inputs);
            option->run_callback();
        }
    }
}

CommandLine parse(CLI::App& app, std::span<const char* const> arguments) {
    CommandLine line;
    Configuration& configuration = line.configuration;
    if (std::filesystem::is_directory(kStudioLights)) {
        configuration.environments = kStudioLights;
    }
    bool check = false;
    std::filesystem::path file;
    app.set_version_flag("--version", kVersion);
    app.add_flag("--check-config", check, "Say whether the configuration is sound, and end");
    app.add_option("--config", file, "Configuration file, TOML")->envname("RELUME_CONFIG");
    OptionSet options(app);
    add_places(options, configuration);
    add_access(options, configuration);
    add_running(options, configuration);
    add_rooms(options, configuration);
    add_limits(options, configuration);
    add_connections(options, configuration);
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    if (!file.empty()) {
        read_configuration_file(app, file);
    }
    configuration.rooms.room.limits = configuration.limits;
    configuration.environment_bounds.uploads =
        static_cast<std::size_t>(configuration.limits.uploads);
    line.request = check ? Request::check_configuration : Request::serve;
    return line;
}

}  // namespace

CommandLine parse_command_line(std::span<const char* const> arguments) {
    CLI::App app("Relights scenes for people who watch them change.", "relume-server");
    try {
        return parse(app, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            throw CommandLineExit(program::kWrongUsage,
                                  "relume-server: " + program::text_from_mistake(app, error) +
                                      "; --help names what there is\n");
        }
        std::ostringstream out;
        app.exit(error, out, out);
        throw CommandLineExit(program::kDone, out.str());
    }
}

}  // namespace relume::net
