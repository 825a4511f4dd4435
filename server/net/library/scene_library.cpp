#include "server/net/library/scene_library.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "protocol/base/text/names.h"
#include "protocol/base/text/near_names.h"
#include "protocol/transport/transport.h"
#include "server/net/library/editable_materials.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>

namespace relume::net {

namespace fs = std::filesystem;

namespace {

wire::Camera camera_of(const view::Look& look) {
    return {.eye = look.eye,
            .look_at = look.look_at,
            .up = look.up.normalized(),
            .fov_degrees = std::clamp(look.fov_degrees, wire::kFieldOfViewDegrees.lowest,
                                      wire::kFieldOfViewDegrees.highest)};
}

std::optional<wire::SceneBounds> bounds_of(const served::Scene& scene) {
    if (!scene.bounds()) {
        return std::nullopt;
    }
    return wire::SceneBounds{.centre = scene.bounds()->centre,
                             .radius = scene.bounds()->radius};
}

std::vector<wire::EditableMaterial> materials_of(const served::Scene& scene) {
    std::vector<wire::EditableMaterial> materials;
    for (const transport::CurveRecord& record : scene.curves()) {
        materials.push_back(editable_material(record));
    }
    return materials;
}

std::vector<wire::ScenePart> parts_of(const served::Scene& scene) {
    std::vector<wire::ScenePart> parts;
    for (const served::ScenePart& part : scene.parts()) {
        parts.push_back({.id = part.id, .name = part.name});
    }
    return parts;
}

std::vector<std::string> edits_of(const served::Scene& scene) {
    std::vector<std::string> edits{"strategy", "budget", "display"};
    if (!scene.is_lit()) {
        edits.insert(edits.begin(), "materials");
        return edits;
    }
    edits.insert(edits.begin(), {"environment", "blend", "rotation", "lights", "background"});
    if (scene.editable_points()) {
        edits.insert(edits.begin(), "materials");
    }
    if (scene.view_can_move()) {
        edits.insert(edits.end(), {"camera", "image"});
    }
    if (scene.lit_surface()) {
        edits.insert(edits.end(), "finishes");
    }
    return edits;
}

}  // namespace

wire::SceneSummary ServedScene::summary() const {
    const transport::Manifest& manifest = loaded->transport().manifest();
    const bool has_order = loaded->is_lit() && loaded->projection().basis().order() > 0;
    const auto& sampling = manifest.sampling_error;
    const auto& lit = loaded->lit_surface();
    return {
        .name = name,
        .kind = std::string(transport::kKindNames.name(manifest.kind)),
        .width = loaded->image().width,
        .height = loaded->image().height,
        .basis = std::string(transport::name_of(manifest.signal_basis)),
        .order = has_order ? std::optional(loaded->projection().basis().order()) : std::nullopt,
        .face_resolution = loaded->is_lit() ? loaded->face_resolution() : 0,
        .columns = static_cast<std::uint32_t>(loaded->columns().count()),
        .channels = manifest.colour.channels,
        .bytes = loaded->transport().total_bytes(),
        .memory_bytes = loaded->bytes(),
        .bake_error = sampling ? std::optional(sampling->natural) : std::nullopt,
        .camera = camera_of(loaded->beginning()),
        .bounds = bounds_of(*loaded),
        .materials = materials_of(*loaded),
        .visibility_resolution = lit ? std::optional(lit->face_resolution()) : std::nullopt,
        .parts = parts_of(*loaded),
        .edits = edits_of(*loaded)};
}

namespace {

bool is_scene(const fs::directory_entry& entry) {
    std::error_code not_there;  // it may have gone meanwhile
    return entry.path().extension() == ".relume" && entry.is_directory(not_there);
}

}  // namespace

SceneLibrary::SceneLibrary() : followed_(is_scene, kMaxScenes) {}

bool SceneLibrary::refresh(const fs::path& folder,
                           Patience patience,
                           const std::stop_token& stop) {
    const auto changes = followed_.look(folder, patience);
    if (followed_.too_many() > 0 && patience == Patience::none) {
        spdlog::warn("scenes_left_out folder={:?} found={} served={}", folder.string(),
                     followed_.too_many(), kMaxScenes);
    }
    bool changed = false;
    for (const FollowedFolder::Change& change : changes) {
        if (stop.stop_requested()) {
            break;
        }
        changed = follow(change) || changed;
    }
    return changed;
}

bool SceneLibrary::follow(const FollowedFolder::Change& change) {
    const fs::path& directory = change.entry;
    if (change.is_gone) {
        const std::lock_guard lock(mutex_);
        spdlog::info("scene_gone directory={:?}", directory.string());
        return scenes_.erase(directory.stem().string()) != 0;
    }
    try {
        open(directory);
        return true;
    } catch (const std::exception& failure) {
        spdlog::error("scene_broken directory={:?} reason={:?} served_as_before={}",
                      directory.string(), failure.what(),
                      find(directory.stem().string()) != nullptr);
        return false;
    }
}

void SceneLibrary::open(const fs::path& directory) {
    const std::string name = directory.stem().string();
    if (!text::is_name(name)) {
        throw std::runtime_error(
            fmt::format("the name of a scene must be {}", text::kNameRule));
    }
    std::shared_ptr<const transport::Transport> transport =
        transport::Transport::open(directory);
    const std::uint64_t bytes = transport->total_bytes();
    auto loaded = std::make_shared<const served::Scene>(std::move(transport));
    auto sky = loaded->view_can_move()
                   ? nullptr
                   : std::make_shared<const SkyPixels>(*loaded->make_view());
    std::shared_ptr<const ServedScene> scene =
        std::make_shared<const ServedScene>(ServedScene{.name = name,
                                                        .directory = directory,
                                                        .loaded = std::move(loaded),
                                                        .sky = std::move(sky)});
    const transport::TileGrid& image = scene->loaded->image();
    spdlog::info("scene_opened name={} width={} height={} columns={} bytes={} memory_bytes={}",
                 name, image.width, image.height, scene->loaded->columns().count(), bytes,
                 scene->loaded->bytes());
    const std::lock_guard lock(mutex_);
    scenes_[name].swap(scene);  // the former one, if it was the last hold, ends after the lock
}

std::shared_ptr<const ServedScene> SceneLibrary::find(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    const auto found = scenes_.find(name);
    return found == scenes_.end() ? nullptr : found->second;
}

std::vector<std::shared_ptr<const ServedScene>> SceneLibrary::list() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::shared_ptr<const ServedScene>> all;
    all.reserve(scenes_.size());
    for (const auto& [name, scene] : scenes_) {
        all.push_back(scene);
    }
    return all;
}

std::string SceneLibrary::expected_in_place_of(std::string_view name) const {
    std::vector<std::string> known;
    for (const auto& scene : list()) {
        known.push_back(scene->name);
    }
    return text::expected_name(name, known, "scenes");
}

std::uint64_t SceneLibrary::total_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& scene : list()) {
        bytes += scene->loaded->transport().total_bytes();
    }
    return bytes;
}

std::optional<std::string> read_picture(const ServedScene& scene, ScenePicture picture) {
    // Sent to anybody who asks: no link may lead to another file.
    try {
        return files::read_regular_file(scene.directory / "view" / kScenePictures.name(picture),
                                        SceneLibrary::kMaxPictureBytes, files::Links::refuse);
    } catch (const files::FileError&) {
        return std::nullopt;
    }
}

}  // namespace relume::net
