#include "server/net/http/static_files.h"

#include "protocol/base/files/regular_file.h"
#include "protocol/transport/checksum.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kIndex = "/index.html";
// Vite names what it builds by content: such a file never changes.
constexpr std::string_view kHashedFolder = "/assets/";

constexpr std::array<std::pair<std::string_view, std::string_view>, 17> kContentTypes{{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".webp", "image/webp"},
    {".avif", "image/avif"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".woff", "font/woff"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
}};

constexpr std::string_view kNoPage =
    "This is a Relume server. It answers at /api/scenes and /session/ROOM, but was given no "
    "page:\nbuild client/web (npm ci && npm run build) and start the server with "
    "--web-root client/web/dist.\n";

std::string_view content_type_of(const fs::path& path) {
    const std::string extension = path.extension().string();
    for (const auto& [known, type] : kContentTypes) {
        if (known == extension) {
            return type;
        }
    }
    return "application/octet-stream";
}

StaticFile make_file(std::string body, std::string_view content_type, bool immutable) {
    const std::uint64_t checksum = transport::checksum(std::as_bytes(std::span(body)));
    return {.body = std::make_shared<const std::string>(std::move(body)),
            .content_type = std::string(content_type),
            .entity_tag = fmt::format("\"{}\"", transport::text_from_checksum(checksum)),
            .cache_control = immutable ? "public, max-age=31536000, immutable" : "no-cache"};
}

std::string read_file(const fs::path& path, std::size_t max_bytes) {
    if (fs::file_size(path) > max_bytes) {
        throw std::runtime_error(
            fmt::format("the page is larger than {} bytes", StaticFiles::kMaxTotalBytes));
    }
    return files::read_regular_file(path, max_bytes, files::Links::refuse);
}

}  // namespace

StaticFiles::StaticFiles() {
    files_.emplace(kIndex, make_file(std::string(kNoPage), "text/plain; charset=utf-8", false));
}

StaticFiles::StaticFiles(const fs::path& folder) {
    std::size_t bytes_left = kMaxTotalBytes;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_symlink() || !entry.is_regular_file()) {
            continue;
        }
        if (files_.size() == kMaxFiles) {
            throw std::runtime_error(
                fmt::format("{} holds more than {} files", folder.string(), kMaxFiles));
        }
        std::string path = "/" + fs::relative(entry.path(), folder).generic_string();
        std::string body = read_file(entry.path(), bytes_left);
        bytes_left -= body.size();
        const bool immutable = path.starts_with(kHashedFolder);
        StaticFile file = make_file(std::move(body), content_type_of(entry.path()), immutable);
        files_.emplace(std::move(path), std::move(file));
    }
    if (!files_.contains(kIndex)) {
        throw std::runtime_error(
            fmt::format("{} holds no index.html: it is no built page", folder.string()));
    }
}

const StaticFile* StaticFiles::find(std::string_view path) const {
    auto found = files_.find(path);
    const std::string_view last = path.substr(path.rfind('/') + 1);
    if (found == files_.end() && last.find('.') == std::string_view::npos) {
        found = files_.find(kIndex);
    }
    return found == files_.end() ? nullptr : &found->second;
}

}  // namespace relume::net
