#include "server/net/rooms/document.h"

#include "protocol/wire/room_patch.h"
#include "server/net/rooms/curve_edits.h"

#include <string>
#include <utility>

namespace relume::net {

Document::Document(const wire::SceneSummary& scene,
                   std::shared_ptr<Environment> environment,
                   std::span<const transport::CurveRecord> curves)
    : scene_(scene), curves_(curves) {
    state_.camera = scene.camera.value_or(wire::Camera{});
    state_.image = {.width = scene.width, .height = scene.height};
    state_.environment.name = environment->description().name;
    environments_.environment = std::move(environment);
}

namespace {

// People choose sizes that a server can hold and draw.
void require_drawable(const wire::ImageSize& image, const wire::Limits& limits) {
    const auto require_side = [](const char* path, std::uint32_t side) {
        if (side > wire::kMaxChosenSide) {
            throw wire::WireError(wire::ErrorCode::out_of_range, path, std::to_string(side),
                                  "1 to " + std::to_string(wire::kMaxChosenSide));
        }
    };
    require_side("/image/width", image.width);
    require_side("/image/height", image.height);
    const std::uint64_t pixels = std::uint64_t{image.width} * image.height;
    if (pixels > limits.image_pixels) {
        throw wire::WireError(wire::ErrorCode::too_large, "/image",
                              std::to_string(pixels) + " pixels",
                              "at most " + std::to_string(limits.image_pixels));
    }
}

}  // namespace

DocumentChange Document::edit(ViewerId author,
                              const wire::Edit& edit,
                              const wire::Limits& limits,
                              const Libraries& libraries) {
    wire::RoomState next = state_;
    const nlohmann::json patch = with_fresh_finishes(
        with_samples(edit.patch, state_.materials, curves_), state_.finishes);
    DocumentChange change{.revision = revision_ + 1,
                          .patch = wire::apply_patch(next, patch, limits).patch,
                          .author = author,
                          .edit_id = edit.id,
                          .stages = {}};
    wire::require_kept(state_, next, scene_.edits);
    if (next.image != state_.image) {
        require_drawable(next.image, limits);
    }
    change.stages = wire::stages_of(change.patch);
    NamedFinishes finishes =
        finishes_after(finishes_, next, change.patch, scene_, libraries.materials);
    environments_ =
        environments_after(environments_, next, change.patch, libraries.environments);
    finishes_ = std::move(finishes);
    state_ = std::move(next);
    advance(change);
    return change;
}

std::optional<DocumentChange> Document::environment_replaced(
    const std::string& name, const EnvironmentLibrary& library) {
    DocumentChange change{.revision = revision_ + 1,
                          .patch = nlohmann::json::object(),
                          .author = {},
                          .edit_id = {},
                          .stages = {}};
    if (state_.environment.name == name) {
        change.patch["environment"]["name"] = name;
    }
    if (state_.blend.name == name) {
        change.patch["blend"]["name"] = name;
    }
    if (change.patch.empty()) {
        return std::nullopt;
    }
    change.stages = wire::stages_of(change.patch);
    environments_ = environments_after(environments_, state_, change.patch, library);
    advance(change);
    return change;
}

void Document::advance(const DocumentChange& change) {
    revision_ = change.revision;
    if (changes_pixels(change.stages)) {
        revision_of_pixels_ = revision_;
    }
}

}  // namespace relume::net
