// Environments given on the command line: a name that the server knows, or a file to send it.
#pragma once

#include "client/cli/url.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace relume::cli {

// How the server shall read a file; each "" for its own guess. Names as in
// protocol/README.md §3.
struct MapReading {
    std::string projection = {};
    std::string centre = {};
    std::string layer = {};
};

// The options --projection, --centre and --layer.
void add_map_options(CLI::App& command, MapReading& reading);

// STEM-HASH, a valid name: the file's stem with other characters replaced by '-' and cut, and
// 16 hexadecimal digits of the content and how it is read, so that one content always gets one
// name.
[[nodiscard]] std::string upload_name(const std::filesystem::path& file,
                                      std::string_view content,
                                      const MapReading& reading);

// Returns the environment's name on the server. A readable file is uploaded, unless the server
// has it from before; anything else is taken as a name. `token` "" where it asks for none.
// Throws ClientError.
[[nodiscard]] std::string environment_on_server(const Url& server,
                                                const std::string& token,
                                                const std::string& file_or_name,
                                                const MapReading& reading);

}  // namespace relume::cli
