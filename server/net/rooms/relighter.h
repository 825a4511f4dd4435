// What one room computes: a signal from its state, sums from the signal, an image from the
// sums. After an edit only the stages that it touches run again, and those that follow from
// them.
#pragma once

#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/engine/session.h"
#include "server/materials/material_layer.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/display_tables.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/image_frame.h"
#include "server/net/images/picture.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/named_environments.h"
#include "server/net/rooms/named_finishes.h"
#include "server/net/rooms/room_layer.h"
#include "server/net/rooms/room_signal.h"
#include "server/net/rooms/stages.h"
#include "server/net/rooms/step_budget.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace relume::net {

// Not thread-safe: a room calls it from one worker at a time.
class Relighter {
  public:
    // `ceiling` is the longest that one call of advance_together takes; columns of materials
    // that are edited beside the light take `material_bytes`.
    Relighter(std::shared_ptr<const ServedScene> scene,
              Metrics& metrics,
              Clock::duration ceiling,
              std::size_t material_bytes = materials::kUsualMaterialBytes);

    // Gives the state that images show from now on. `stages` are those in which it differs from
    // the state before (all of them in the first call); no other stage runs again. A new
    // signal begins a new step. An environment that cannot be decoded is black, and the result
    // names it.
    std::vector<wire::ErrorMessage> set_state(const wire::RoomState& state,
                                              const NamedEnvironments& environments,
                                              const NamedFinishes& finishes,
                                              wire::Stages stages);

    // Relights a slice for each, in one sweep over the transport: as much as the budget of its
    // state leaves for the step, but no longer than the ceiling. All are of one scene and none
    // is at rest.
    static void advance_together(std::span<Relighter* const> relighters);
    // Whether the image holds what the budget allows, and may be shown.
    [[nodiscard]] bool step_is_complete() const;
    // Whether the image is still that of the light before.
    [[nodiscard]] bool shows_state_before() const {
        return shows_transport() && session_.shows_target_before();
    }
    // Nothing is left to do: exact, or the target error is met.
    [[nodiscard]] bool at_rest() const;
    [[nodiscard]] double stated_error() const;
    // Whether the image, or a JPEG of it, would differ from the one composed last.
    [[nodiscard]] bool image_changed() const { return image_changed_; }
    // Rises whenever the image's linear pixels may have changed.
    [[nodiscard]] std::uint64_t pixels() const { return pixels_; }

    // Composes the image as it stands. The picture before must have been encoded.
    [[nodiscard]] Picture picture(const ImageStamp& stamp,
                                  const ImageForms& forms,
                                  int jpeg_quality);
    // The milliseconds that an image of this room spends outside this class: waiting for a
    // worker, and being encoded. The budget of later steps is smaller by them (StepBudget).
    void set_overhead(double milliseconds) { budget_.set_overhead(milliseconds); }

  private:
    [[nodiscard]] bool exact() const;
    // Whether any pixel shows the transport: a layer may hide all of it.
    [[nodiscard]] bool shows_transport() const { return !layer_ || layer_->shows_transport(); }
    [[nodiscard]] bool transport_rests() const;
    [[nodiscard]] bool layer_waits() const { return layer_ && layer_->awaits_first_look(); }
    // The view has changed, or what it shows of the transport and the layer.
    void looked_anew();
    void advance_layer(double milliseconds);
    void look_closer();
    void relit(const engine::StepReport& report, Clock::duration spent);
    void pixels_changed();
    void compose(const ImageForms& forms, bool settled);

    const std::shared_ptr<const ServedScene> scene_;
    Metrics& metrics_;
    engine::Session session_;
    const std::unique_ptr<RoomLayer> layer_;  // null where light or curves alone are edited
    std::shared_ptr<FrameComposer> composer_;

    const std::unique_ptr<RoomSignal> signal_;

    std::optional<wire::RoomState> state_;
    DisplayTables displays_;
    StepBudget budget_;

    std::uint64_t pixels_ = 0;
    bool image_changed_ = true;
    // Since the last image:
    Clock::duration relight_time_{};
    std::uint32_t applied_ = 0;
    std::uint32_t remaining_ = 0;
};

}  // namespace relume::net
