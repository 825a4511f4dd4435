#include "server/net/rooms/document.h"

#include "protocol/wire/room_patch.h"

#include <utility>

namespace relume::net {

Document::Document(const wire::SceneSummary& scene, std::shared_ptr<Environment> environment)
    : edits_(scene.edits) {
    state_.image = {.width = scene.width, .height = scene.height};
    state_.environment.name = environment->description().name;
    environments_.environment = std::move(environment);
}

DocumentChange Document::edit(ViewerId author,
                              const wire::Edit& edit,
                              const wire::Limits& limits,
                              const EnvironmentLibrary& library) {
    wire::RoomState next = state_;
    DocumentChange change{.revision = revision_ + 1,
                          .patch = wire::apply_patch(next, edit.patch, limits).patch,
                          .author = author,
                          .edit_id = edit.id,
                          .stages = {}};
    wire::require_kept(state_, next, edits_);
    change.stages = wire::stages_of(change.patch);
    environments_ = environments_after(environments_, next, change.patch, library);
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
