#include "base/text/near_files.h"

#include "base/text/near_names.h"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <vector>

namespace relume::text {

namespace fs = std::filesystem;

std::string text_from_missing_file(const fs::path& path) {
    constexpr std::size_t kMostLookedAt = 10'000;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end;
         !error && entry != end && names.size() < kMostLookedAt; entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    std::vector<std::string> near = near_names(path.filename().string(), names);
    for (std::string& name : near) {
        name = (path.parent_path() / name).string();
    }
    return near.empty() ? "no such file or folder"
                        : fmt::format("no such file or folder; did you mean {}?",
                                      fmt::join(near, " or "));
}

}  // namespace relume::text
