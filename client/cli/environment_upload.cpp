#include "client/cli/environment_upload.h"

#include "client/cli/client_error.h"
#include "client/cli/http_client.h"
#include "client/cli/server_names.h"
#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/text/names.h"
#include "protocol/base/text/near_files.h"
#include "protocol/base/text/near_names.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <algorithm>
#include <vector>

namespace relume::cli {
namespace {

namespace fs = std::filesystem;

// Decoding a large map takes the server seconds.
constexpr std::chrono::seconds kUploadTimeout{180};
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 30;

std::string content_of(const fs::path& path) {
    try {
        return files::read_regular_file(path, kMaxFileBytes);
    } catch (const files::FileError& error) {
        throw ClientError(error.what());
    }
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

// What is meant by words that are no file: a name that the server knows.
std::string known_name(const Url& server, const std::string& name) {
    const bool looks_like_a_file =
        name.ends_with(".hdr") || name.ends_with(".exr") || name.find('/') != std::string::npos;
    if (looks_like_a_file || !text::is_name(name)) {
        throw ClientError(fmt::format("environment \"{}\": {}; expected a file or a name: {}",
                                      name, text::text_from_missing_file(name),
                                      text::kNameRule));
    }
    const std::vector<std::string> known = environments_of(server);
    if (!has(known, name)) {
        throw ClientError(
            fmt::format("environment \"{}\": neither a file here nor known to the "
                        "server, expected {}",
                        name, text::expected_name(name, known, "environments")));
    }
    return name;
}

}  // namespace

void add_map_options(CLI::App& command, MapReading& reading) {
    command.add_option("--projection", reading.projection,
                       "projection of the file (default: by its shape)");
    command.add_option(
        "--centre", reading.centre,
        "where the map's centre looks: -z, +z, +x, -x, +y or -y (default: -z; +x "
        "for maps made for Blender or three.js)");
    command.add_option("--layer", reading.layer,
                       "layer of an EXR file (default: the beauty); a wrong one lists all");
}

std::string upload_name(const fs::path& file,
                        std::string_view content,
                        const MapReading& reading) {
    constexpr std::size_t kHashDigits = 16;
    std::string stem = file.stem().string();
    for (char& c : stem) {
        if (!text::is_name(std::string("x") + c)) {
            c = '-';
        }
    }
    const std::size_t first = stem.find_first_not_of('.');
    stem = first == std::string::npos ? "environment" : stem.substr(first);
    stem.resize(std::min(stem.size(), text::kMaxNameLength - kHashDigits - 1));
    const std::string how =
        fmt::format("{}\n{}\n{}", reading.projection, reading.centre, reading.layer);
    const XXH64_hash_t seed = XXH3_64bits(how.data(), how.size());
    return fmt::format("{}-{:016x}", stem,
                       XXH3_64bits_withSeed(content.data(), content.size(), seed));
}

std::string environment_on_server(const Url& server,
                                  const std::string& token,
                                  const std::string& file_or_name,
                                  const MapReading& reading) {
    std::error_code ignored;
    if (!fs::is_regular_file(file_or_name, ignored)) {
        return known_name(server, file_or_name);
    }
    std::string content = content_of(file_or_name);
    const std::string name = upload_name(file_or_name, content, reading);
    if (has(environments_of(server), name)) {
        return name;
    }
    std::string target = "/api/environments?name=" + percent_encoded(name);
    const auto ask = [&target](const char* key, const std::string& value) {
        if (!value.empty()) {
            target += fmt::format("&{}={}", key, percent_encoded(value));
        }
    };
    ask("projection", reading.projection);
    ask("centre", reading.centre);
    ask("layer", reading.layer);
    const nlohmann::json answer = json_from_answer(
        http_post(server, target, token, std::move(content), kUploadTimeout), "POST " + target);
    for (const auto& warning : answer.value("warnings", nlohmann::json::array())) {
        spdlog::warn("{}: {}", file_or_name,
                     warning.is_string() ? warning.get<std::string>() : warning.dump());
    }
    return answer.at("name");
}

}  // namespace relume::cli
