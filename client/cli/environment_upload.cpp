#include "client/cli/environment_upload.h"

#include "client/cli/client_error.h"
#include "client/cli/http_client.h"
#include "protocol/wire/names.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <xxhash.h>

#include <fstream>
#include <iterator>

namespace relume::cli {
namespace {

namespace fs = std::filesystem;

// Decoding a large map takes the server seconds.
constexpr std::chrono::seconds kUploadTimeout{180};
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 30;

std::string content_of(const fs::path& path) {
    const std::uintmax_t bytes = fs::file_size(path);
    if (bytes > kMaxFileBytes) {
        throw ClientError(fmt::format("{}: found {} bytes, expected at most {}", path.string(),
                                      bytes, kMaxFileBytes));
    }
    std::ifstream file(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(file), {}};
    if (!file) {
        throw ClientError(path.string() + ": cannot be read");
    }
    return content;
}

bool server_has(const Url& server, const std::string& name) {
    const std::string target = "/api/environments";
    const nlohmann::json answer = json_from_answer(http_get(server, target), "GET " + target);
    for (const auto& environment : answer.at("environments")) {
        if (environment.at("name") == name) {
            return true;
        }
    }
    return false;
}

}  // namespace

std::string upload_name(const fs::path& file,
                        std::string_view content,
                        std::string_view projection) {
    constexpr std::size_t kHashDigits = 16;
    std::string stem = file.stem().string();
    for (char& c : stem) {
        if (!wire::is_name(std::string("x") + c)) {
            c = '-';
        }
    }
    const std::size_t first = stem.find_first_not_of('.');
    stem = first == std::string::npos ? "environment" : stem.substr(first);
    stem.resize(std::min(stem.size(), wire::kMaxNameLength - kHashDigits - 1));
    const XXH64_hash_t seed = XXH3_64bits(projection.data(), projection.size());
    return fmt::format("{}-{:016x}", stem,
                       XXH3_64bits_withSeed(content.data(), content.size(), seed));
}

std::string environment_on_server(const Url& server,
                                  const std::string& token,
                                  const std::string& file_or_name,
                                  const std::string& projection) {
    std::error_code ignored;
    if (!fs::is_regular_file(file_or_name, ignored)) {
        const bool looks_like_a_file =
            file_or_name.ends_with(".hdr") || file_or_name.ends_with(".exr");
        if (looks_like_a_file || !wire::is_name(file_or_name)) {
            throw ClientError(fmt::format(
                "environment \"{}\": found no such file, expected a file or a name: {}",
                file_or_name, wire::kNameRule));
        }
        return file_or_name;
    }
    std::string content = content_of(file_or_name);
    const std::string name = upload_name(file_or_name, content, projection);
    if (server_has(server, name)) {
        return name;
    }
    std::string target = "/api/environments?name=" + percent_encoded(name);
    if (!projection.empty()) {
        target += "&projection=" + percent_encoded(projection);
    }
    const std::string request = "POST " + target;
    if (!token.empty()) {
        target += "&token=" + percent_encoded(token);
    }
    const nlohmann::json answer = json_from_answer(
        http_post(server, target, std::move(content), kUploadTimeout), request);
    for (const auto& warning : answer.value("warnings", nlohmann::json::array())) {
        spdlog::warn("{}: {}", file_or_name,
                     warning.is_string() ? warning.get<std::string>() : warning.dump());
    }
    return answer.at("name");
}

}  // namespace relume::cli
