// What the people in a room have agreed on: one state, changed by edits that are numbered.
#pragma once

#include "protocol/transport/curves_section.h"
#include "protocol/wire/limits.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "protocol/wire/scene_summary.h"
#include "server/net/library/libraries.h"
#include "server/net/rooms/named_environments.h"
#include "server/net/rooms/named_finishes.h"
#include "server/net/rooms/stages.h"
#include "server/net/rooms/viewer.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relume::net {

// One entry of the document's history.
struct DocumentChange {
    std::uint64_t revision = 0;
    nlohmann::json patch;                  // normalised
    std::optional<ViewerId> author;        // none when the server itself made it
    std::optional<std::uint64_t> edit_id;  // of the author's message
    wire::Stages stages;
};

// Not thread-safe.
class Document {
  public:
    // Revision 0 is the default state of a room of `scene` under this environment. `curves` are
    // those of its materials, and outlive the document.
    Document(const wire::SceneSummary& scene,
             std::shared_ptr<Environment> environment,
             std::span<const transport::CurveRecord> curves = {});

    // Throws wire::WireError naming what in the patch cannot be; the document is then as
    // before.
    [[nodiscard]] DocumentChange edit(ViewerId author,
                                      const wire::Edit& edit,
                                      const wire::Limits& limits,
                                      const Libraries& libraries);
    // Another map has taken its place behind `name`. Where the state names it, the state takes
    // the new map, and the change that is returned names it once more; otherwise nothing
    // happens.
    [[nodiscard]] std::optional<DocumentChange> environment_replaced(
        const std::string& name, const EnvironmentLibrary& library);

    [[nodiscard]] const wire::RoomState& state() const { return state_; }
    [[nodiscard]] const NamedEnvironments& environments() const { return environments_; }
    [[nodiscard]] const NamedFinishes& finishes() const { return finishes_; }
    [[nodiscard]] std::uint64_t revision() const { return revision_; }
    // The last revision that may have changed linear pixels. An image of this or a later
    // revision has the linear pixels of the state; display and policy may have changed since.
    [[nodiscard]] std::uint64_t revision_of_pixels() const { return revision_of_pixels_; }

  private:
    void advance(const DocumentChange& change);

    const wire::SceneSummary scene_;
    const std::span<const transport::CurveRecord> curves_;
    wire::RoomState state_;
    NamedEnvironments environments_;
    NamedFinishes finishes_;
    std::uint64_t revision_ = 0;
    std::uint64_t revision_of_pixels_ = 0;
};

}  // namespace relume::net
