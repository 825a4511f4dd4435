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

}  // namespace relume::scene
