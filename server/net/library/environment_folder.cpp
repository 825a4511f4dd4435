#include "server/net/library/environment_folder.h"

#include "protocol/base/text/names.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

bool is_environment_file(const fs::directory_entry& entry) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".hdr" || extension == ".exr";
}

}  // namespace

EnvironmentFolder::EnvironmentFolder(EnvironmentLibrary& library,
                                     fs::path folder,
                                     light::MapCentre centre)
    : library_(library),
      folder_(std::move(folder)),
      centre_(centre),
      followed_(is_environment_file, kMaxFiles) {}

void EnvironmentFolder::refresh(Patience patience) {
    for (const FollowedFolder::Change& change : followed_.look(folder_, patience)) {
        try {
            follow(change);
        } catch (const std::exception& failure) {
            spdlog::error("environment_broken file={:?} reason={:?}", change.entry.string(),
                          failure.what());
        }
    }
}

void EnvironmentFolder::follow(const FollowedFolder::Change& change) {
    if (!change.is_gone) {
        add(change.entry);
        return;
    }
    const std::string name = change.entry.stem().string();
    const auto offered = offered_.find(name);
    if (offered == offered_.end() || offered->second != change.entry) {
        return;
    }
    spdlog::info("environment_gone file={:?}", change.entry.string());
    offered_.erase(offered);
    library_.remove_file(name);
    // Another file may have been kept out by this one's name.
    for (const fs::path& other : followed_.entries()) {
        if (other.stem().string() == name) {
            add(other);
            return;
        }
    }
}

void EnvironmentFolder::add(const fs::path& file) {
    const std::string name = file.stem().string();
    if (!text::is_name(name)) {
        throw std::runtime_error(
            fmt::format("the name of an environment must be {}", text::kNameRule));
    }
    const auto offered = offered_.find(name);
    if (offered != offered_.end() && offered->second != file) {
        throw std::runtime_error(fmt::format("there is an environment {} already, from {}",
                                             name, offered->second.filename().string()));
    }
    const light::ImportOptions options{.centre = centre_};
    const light::EnvironmentHeader header = light::read_environment_header(file, options);
    library_.put_file(name, header.width, header.height, [file, options] {
        light::ImportedEnvironment imported = light::import_environment(file, options);
        for (const std::string& warning : imported.notes.warnings) {
            spdlog::warn("environment_changed file={:?} warning={:?}", file.string(), warning);
        }
        return std::move(imported.map);
    });
    offered_.insert_or_assign(name, file);
}

}  // namespace relume::net
