#include "client/cli/client_error.h"
#include "client/cli/commands.h"
#include "client/cli/http_client.h"
#include "client/cli/room_connection.h"

#include <CLI/CLI.hpp>
#include <boost/asio/io_context.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>

namespace relume::cli {
namespace {

using nlohmann::json;

struct ListingOptions {
    ServerOptions server;
    bool json = false;
};

json get_json(const Url& server, const std::string& target) {
    return json_from_answer(http_get(server, target), "GET " + target);
}

std::string text_of(const json& value) {
    if (value.is_string()) {
        return value.get<std::string>();
    }
    return value.is_null() ? "-" : value.dump();
}

// Objects as lines of aligned columns under their keys.
void print_table(const json& rows, const std::vector<std::string>& columns) {
    std::vector<std::size_t> widths;
    for (const std::string& column : columns) {
        std::size_t width = column.size();
        for (const json& row : rows) {
            width = std::max(width, text_of(row.value(column, json())).size());
        }
        widths.push_back(width);
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
        fmt::print("{:<{}}{}", columns[c], widths[c], c + 1 < columns.size() ? "  " : "\n");
    }
    for (const json& row : rows) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            fmt::print("{:<{}}{}", text_of(row.value(columns[c], json())), widths[c],
                       c + 1 < columns.size() ? "  " : "\n");
        }
    }
}

void list(const ListingOptions& options,
          const std::string& kind,
          const std::vector<std::string>& columns) {
    const json answer = get_json(url_from_text(options.server.url), "/api/" + kind);
    const json& rows = answer.at(kind);
    if (options.json) {
        fmt::print("{}\n", rows.dump());
    } else {
        print_table(rows, columns);
    }
}

// Limits are stated in a snapshot; a room of one's own gives one.
json limits_in_force(const Url& server, const std::string& token, const std::string& scene) {
    boost::asio::io_context io(1);
    std::optional<wire::Limits> limits;
    std::string why;
    std::optional<RoomConnection> connection;
    connection.emplace(
        io,
        ConnectionOptions{.server = server,
                          .room = random_room_name("info"),
                          .scene = scene,
                          .images = ImageChoice::settled,
                          .token = token},
        ConnectionListener{.on_snapshot =
                               [&](const wire::Snapshot& snapshot) {
                                   limits = snapshot.limits;
                                   connection->close();
                               },
                           .on_end = [&](const ConnectionEnd& end) { why = end.reason; }});
    connection->open();
    io.run();
    if (!limits) {
        throw ClientError("no connection with the server: " + why);
    }
    return wire::to_json(*limits);
}

void info(const ListingOptions& options) {
    const Url server = url_from_text(options.server.url);
    const bool ready = http_get(server, "/readyz").status == 200;
    json result = {{"server", options.server.url},
                   {"healthy", http_get(server, "/healthz").status == 200},
                   {"ready", ready},
                   {"protocol", wire::kProtocolVersion}};
    if (ready) {
        const json scenes = get_json(server, "/api/scenes").at("scenes");
        result["scenes"] = scenes.size();
        result["environments"] =
            get_json(server, "/api/environments").at("environments").size();
        if (!scenes.empty()) {
            result["limits"] =
                limits_in_force(server, options.server.token, scenes[0].at("name"));
        }
    }
    if (options.json) {
        fmt::print("{}\n", result.dump());
        return;
    }
    for (const auto& [key, value] : result.items()) {
        if (!value.is_object()) {
            fmt::print("{:<24}{}\n", key, text_of(value));
        }
    }
    const json limits = result.value("limits", json::object());
    for (const auto& [key, value] : limits.items()) {
        fmt::print("{:<24}{}\n", key, text_of(value));
    }
}

CLI::App* add_listing(CLI::App& app,
                      const std::shared_ptr<ListingOptions>& options,
                      const char* name,
                      const char* description) {
    CLI::App* command = app.add_subcommand(name, description);
    add_server_options(*command, options->server);
    command->add_flag("--json", options->json, "print JSON");
    return command;
}

}  // namespace

void add_server_options(CLI::App& command, ServerOptions& options) {
    command.add_option("--server", options.url, "http:// or ws:// URL of the server")
        ->envname("RELUME_SERVER")
        ->capture_default_str();
    command.add_option("--token", options.token, "what the server asks clients for")
        ->envname("RELUME_TOKEN");
}

void add_listing_commands(CLI::App& app) {
    const auto scenes = std::make_shared<ListingOptions>();
    add_listing(app, scenes, "scenes", "List the server's scenes.")->callback([scenes] {
        list(*scenes, "scenes",
             {"name", "width", "height", "basis", "face_resolution", "columns", "bytes",
              "memory_bytes"});
    });
    const auto environments = std::make_shared<ListingOptions>();
    add_listing(app, environments, "environments", "List the server's environments.")
        ->callback([environments] {
            list(*environments, "environments", {"name", "kind", "width", "height"});
        });
    const auto materials = std::make_shared<ListingOptions>();
    add_listing(app, materials, "materials",
                "List the materials that parts of the server's scenes may be given.")
        ->callback([materials] {
            list(*materials, "materials",
                 {"name", "face_resolution", "parameter", "steps", "colours"});
        });
    const auto server = std::make_shared<ListingOptions>();
    add_listing(app, server, "info", "Show a server's health and limits.")->callback([server] {
        info(*server);
    });
}

}  // namespace relume::cli
