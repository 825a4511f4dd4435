#include "precompute/scene/import_folder.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace relume::scene {
namespace {

namespace fs = std::filesystem;

bool is_inside(const fs::path& folder, const fs::path& path) {
    const fs::path relative = fs::absolute(path).lexically_normal().lexically_relative(
        fs::absolute(folder).lexically_normal());
    return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

std::string percent_decoded(const std::string& text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned value = 0;
        if (text[i] == '%' && i + 2 < text.size()) {
            const char* end = text.data() + i + 3;
            if (std::from_chars(text.data() + i + 1, end, value, 16).ptr == end) {
                out.push_back(static_cast<char>(value));
                i += 2;
                continue;
            }
        }
        out.push_back(text[i]);
    }
    return out;
}

std::optional<fs::path> path_inside(const fs::path& folder, const std::string& reference) {
    const auto resolved = [&](std::string text) -> std::optional<fs::path> {
        std::replace(text.begin(), text.end(), '\\', '/');
        const fs::path path = folder / text;  // an absolute `text` replaces `folder`
        if (text.empty() || text.find('\0') != std::string::npos || !is_inside(folder, path))
            return std::nullopt;
        return path.lexically_normal();
    };
    auto plain = resolved(reference);
    if (std::error_code error; plain && fs::exists(*plain, error))
        return plain;
    return resolved(percent_decoded(reference));
}

bool FolderIo::is_allowed(const char* file) const {
    std::error_code error;
    if (!is_inside(folder_, file) || !fs::is_regular_file(file, error))
        return false;
    const auto bytes = fs::file_size(file, error);
    return !error && bytes <= max_file_bytes_;
}

bool FolderIo::Exists(const char* file) const {
    return is_allowed(file);
}

Assimp::IOStream* FolderIo::Open(const char* file, const char* mode) {
    const bool reads_only =
        std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    if (reads_only && is_allowed(file))
        return DefaultIOSystem::Open(file, mode);
    refused_.insert(file);
    return nullptr;
}

}  // namespace relume::scene
