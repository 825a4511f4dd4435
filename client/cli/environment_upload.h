// Environments given on the command line: a name that the server knows, or a file to send it.
#pragma once

#include "client/cli/url.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace relume::cli {

// STEM-HASH, a valid name: the file's stem with other characters replaced by '-' and cut, and
// 16 hexadecimal digits of the content and projection, so that one content always gets one
// name.
[[nodiscard]] std::string upload_name(const std::filesystem::path& file,
                                      std::string_view content,
                                      std::string_view projection);

// Returns the environment's name on the server. A readable file is uploaded, unless the server
// has it from before; anything else is taken as a name. `projection` is "" for the server's own
// guess, `token` "" where it asks for none. Throws ClientError.
[[nodiscard]] std::string environment_on_server(const Url& server,
                                                const std::string& token,
                                                const std::string& file_or_name,
                                                const std::string& projection);

}  // namespace relume::cli
