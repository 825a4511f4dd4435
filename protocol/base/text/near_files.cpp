#include "protocol/base/text/near_files.h"

#include "protocol/base/text/near_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace relume::text {

namespace fs = std::filesystem;

std::string text_from_missing_file(const fs::path& path) {
    constexpr std::size_t kMostLookedAt = 10'000;
    constexpr std::size_t kMostNamed = 3;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end;
         !error && entry != end && names.size() < kMostLookedAt; entry.increment(error)) {
        names.push_back(entry->path().filename().string());
    }
    // A name but for its ending comes before all that resemble it.
    std::vector<std::string> near;
    std::copy_if(names.begin(), names.end(), std::back_inserter(near),
                 [&](const std::string& name) {
                     const fs::path stem = fs::path(name).stem();
                     return stem == path.filename() || stem == path.stem();
                 });
    if (near.empty()) {
        near = near_names(path.filename().string(), names);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), kMostNamed));
    for (std::string& name : near) {
        name = (path.parent_path() / name).string();
    }
    return near.empty() ? "no such file or folder"
                        : fmt::format("no such file or folder; did you mean {}?",
                                      fmt::join(near, " or "));
}

}  // namespace relume::text
