// What one room computes: its state as light, the light through the engine, the image composed.
// Each edit runs again only the stages that it concerns, and what comes after them.
#pragma once

#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/engine/session.h"
#include "server/light/light_cubemap.h"
#include "server/light/light_rig.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/display_tables.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/image_frame.h"
#include "server/net/images/picture.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/named_environments.h"
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
    // `ceiling`: of one call of advance_together.
    Relighter(std::shared_ptr<const ServedScene> scene,
              Metrics& metrics,
              Clock::duration ceiling);

    // What the image is to show from now on, which differs from the state before in these
    // stages (in all of them at first): no other is run again. New light begins a new step. An
    // environment that cannot be decoded is black, and named in the result.
    std::vector<wire::ErrorMessage> set_state(const wire::RoomState& state,
                                              const NamedEnvironments& environments,
                                              wire::Stages stages);

    // A slice of relighting for each, all of one scene and not at rest, in one sweep over the
    // transport: as much as the state's budget has left for the step, but for no longer than
    // the ceiling.
    static void advance_together(std::span<Relighter* const> relighters);
    // The image holds what the budget allows, and may be shown.
    [[nodiscard]] bool step_is_complete() const;
    // The image is still of the light before.
    [[nodiscard]] bool shows_state_before() const { return session_.shows_target_before(); }
    // Nothing is left to do: exact, or the target error is met.
    [[nodiscard]] bool at_rest() const { return session_.at_rest(state_->budget); }
    [[nodiscard]] double stated_error() const { return session_.stated_error(); }
    // The image, or a JPEG of it, differs from the one composed last.
    [[nodiscard]] bool image_changed() const { return image_changed_; }
    // Rises whenever the image's linear pixels may have changed.
    [[nodiscard]] std::uint64_t pixels() const { return pixels_; }

    // The image as it stands, composed; the picture before must have been encoded.
    [[nodiscard]] Picture picture(const ImageStamp& stamp,
                                  const ImageForms& forms,
                                  int jpeg_quality);
    // What an image takes besides being lit, relit and composed: to wait for a thread, to be
    // encoded.
    void set_beside(double milliseconds) { budget_.set_beside(milliseconds); }

  private:
    // False when the light is what it was.
    [[nodiscard]] bool set_light(const wire::RoomState& state,
                                 const NamedEnvironments& environments,
                                 std::vector<wire::ErrorMessage>& problems);
    void relit(const engine::StepReport& report, Clock::duration spent);
    void pixels_changed();
    void compose(const ImageForms& forms, bool settled);

    const std::shared_ptr<const ServedScene> scene_;
    Metrics& metrics_;
    engine::Session session_;
    std::shared_ptr<FrameComposer> composer_;

    std::optional<wire::RoomState> state_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
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
