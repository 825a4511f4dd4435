#include "precompute/scene/picture_files.h"

#include "precompute/scene/error.h"
#include "precompute/scene/import_folder.h"
#include "precompute/scene/shown_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <system_error>
#include <vector>

namespace relume::scene {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// `parts` below `folder`, each matched without regard to case.
std::optional<fs::path> in_any_case(const fs::path& folder,
                                    const std::vector<std::string>& parts) {
    fs::path at = folder;
    for (const std::string& part : parts) {
        std::error_code error;
        std::optional<fs::path> found;
        for (const fs::directory_entry& entry : fs::directory_iterator(at, error)) {
            const std::string name = entry.path().filename().string();
            // The smallest name, so that the answer does not hang on the folder's order.
            if (lower(name) == lower(part) && (!found || name < found->filename().string()))
                found = entry.path();
        }
        if (!found)
            return std::nullopt;
        at = *found;
    }
    return is_file(at) ? std::optional(at) : std::nullopt;
}

std::vector<std::string> parts_of(std::string reference) {
    std::replace(reference.begin(), reference.end(), '\\', '/');
    std::vector<std::string> parts;
    std::size_t at = 0;
    while (at <= reference.size()) {
        const std::size_t end = std::min(reference.find('/', at), reference.size());
        const std::string part = reference.substr(at, end - at);
        if (part == "..")
            parts.clear();
        else if (!part.empty() && part != ".")
            parts.push_back(part);
        at = end + 1;
    }
    return parts;
}

}  // namespace

std::optional<fs::path> file_meant(const fs::path& folder, const std::string& reference) {
    if (const auto path = path_inside(folder, reference); path && is_file(*path))
        return path;
    if (reference.find('\0') != std::string::npos)
        return std::nullopt;
    std::vector<std::string> parts = parts_of(reference);
    while (!parts.empty()) {
        if (const auto path = in_any_case(folder, parts))
            return path;
        parts.erase(parts.begin());
    }
    return std::nullopt;
}

PictureFiles::PictureFiles(fs::path folder, std::uint32_t max_textures, Scene& scene)
    : folder_(std::move(folder)), max_textures_(max_textures), scene_(scene) {}

const Texture* PictureFiles::picture(const std::string& reference,
                                     TextureContent content,
                                     const std::string& user) {
    const auto path = file_meant(folder_, reference);
    if (!path) {
        scene_.report.unused.push_back(fmt::format(
            "{}: texture '{}' ({})", user, shown_text(reference),
            path_inside(folder_, reference) ? "no such file" : "outside the scene's folder"));
        return nullptr;
    }
    auto known = known_.find({path->string(), content});
    if (known == known_.end())
        known = known_
                    .emplace(std::pair(path->string(), content),
                             load_texture(path->string(), content))
                    .first;
    return &*known->second;
}

TextureIndex PictureFiles::add(Texture texture) {
    if (scene_.textures.size() >= max_textures_)
        throw SceneError(SceneFault::too_large,
                         fmt::format("scene '{}' has more than {} textures",
                                     shown_text(scene_.name), max_textures_));
    scene_.textures.push_back(std::move(texture));
    return static_cast<TextureIndex>(scene_.textures.size() - 1);
}

}  // namespace relume::scene
