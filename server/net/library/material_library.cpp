#include "server/net/library/material_library.h"

#include "protocol/base/text/names.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

bool is_material_file(const fs::directory_entry& entry) {
    return entry.path().extension() == ".material";
}

void require_name(const fs::path& file) {
    const std::string stem = file.stem().string();
    if (!text::is_name(stem)) {
        throw std::runtime_error(
            fmt::format("the name of a material must be {}", text::kNameRule));
    }
}

void warn_left_out(const fs::path& file, const std::string& reason) {
    spdlog::error("material_broken file={:?} reason={:?}", file.string(), reason);
}

}  // namespace

MaterialLibrary::MaterialLibrary(std::size_t cache_bytes)
    : cache_(std::make_shared<ResidentCache>(cache_bytes)),
      followed_(is_material_file, kMostFiles) {}

void MaterialLibrary::refresh(const fs::path& folder, Patience patience) {
    const auto changes = followed_.look(folder, patience);
    if (changes.empty()) {
        return;
    }
    if (followed_.too_many() > 0) {
        spdlog::warn("materials_left_out folder={:?} found={} offered={}", folder.string(),
                     followed_.too_many(), kMostFiles);
    }
    for (const FollowedFolder::Change& change : changes) {
        if (change.is_gone) {
            files_.erase(change.entry);
            continue;
        }
        try {
            require_name(change.entry);
            files_.insert_or_assign(change.entry,
                                    std::make_shared<TabulatedMaterial>(change.entry, cache_));
        } catch (const std::exception& failure) {
            warn_left_out(change.entry, failure.what());
        }
    }
    std::vector<SharedFamily> offered = families();
    const std::lock_guard lock(mutex_);
    offered_.swap(offered);
}

std::vector<MaterialLibrary::SharedFamily> MaterialLibrary::families() const {
    // A name may stand for files of several resolutions.
    std::map<std::pair<std::string, std::uint32_t>, std::shared_ptr<MaterialFamily>> by_name;
    for (const auto& [file, material] : files_) {
        const MaterialName name = material_name_from_stem(file.stem().string());
        auto& family = by_name[{name.name, material->face_resolution()}];
        if (!family) {
            family = std::make_shared<MaterialFamily>(
                MaterialFamily{.name = name.name, .parameter = name.parameter, .steps = {}});
        } else if (family->parameter != name.parameter || !name.parameter) {
            warn_left_out(file, fmt::format("there is another material {}", name.name));
            continue;
        } else if (family->first().colours().size() != material->colours().size()) {
            warn_left_out(file, fmt::format("{} lobes, expected {} as other steps of {} have",
                                            material->colours().size(),
                                            family->first().colours().size(), name.name));
            continue;
        }
        family->steps.push_back({.number = name.step, .material = material});
    }
    std::vector<SharedFamily> all;
    for (auto& [name, family] : by_name) {
        std::sort(family->steps.begin(), family->steps.end(),
                  [](const auto& a, const auto& b) { return a.number < b.number; });
        all.push_back(std::move(family));
    }
    return all;
}

MaterialLibrary::SharedFamily MaterialLibrary::find(std::string_view name,
                                                    std::uint32_t face_resolution) const {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(offered_.begin(), offered_.end(), [&](const SharedFamily& family) {
            return family->name == name && family->first().face_resolution() == face_resolution;
        });
    return found == offered_.end() ? nullptr : *found;
}

std::vector<MaterialLibrary::SharedFamily> MaterialLibrary::list() const {
    const std::lock_guard lock(mutex_);
    return offered_;
}

}  // namespace relume::net
