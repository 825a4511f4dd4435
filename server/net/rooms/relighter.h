// What one room computes: its state as light, the light through the engine, the image composed.
#pragma once

#include "protocol/relighting/budget.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/engine/session.h"
#include "server/light/light_cubemap.h"
#include "server/light/light_rig.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/display_tables.h"
#include "server/net/images/frame_composer.h"
#include "server/net/images/picture.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/named_environments.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace relume::net {

// Which edit an image answers, and how long that took.
struct ImageStamp {
    std::uint64_t revision = 0;
    std::uint64_t sequence = 0;
    Clock::time_point edit_read_at;
    bool settled = false;  // the state rests
};

// Not thread-safe: a room calls it from one worker at a time.
class Relighter {
  public:
    // `ceiling`: of one call of advance_together.
    Relighter(std::shared_ptr<const ServedScene> scene,
              Metrics& metrics,
              Clock::duration ceiling);

    // What the image is to show from now on; only what differs from before is computed anew. An
    // environment that cannot be decoded is black, and named in the result.
    std::vector<wire::ErrorMessage> set_state(const wire::RoomState& state,
                                              const NamedEnvironments& environments);

    // One image's worth of relighting for each, all of one scene and not at rest, in one sweep:
    // the state's milliseconds less what lighting, composing and encoding have been taking, so
    // that the images are ready when they are over; but no more than the ceiling at once, so
    // that a larger budget takes several calls.
    static void advance_together(std::span<Relighter* const> relighters);
    // The state's image holds what its budget allows, and may be shown.
    [[nodiscard]] bool budget_is_spent() const;
    // The image is still of the state before.
    [[nodiscard]] bool shows_state_before() const { return session_.shows_lighting_before(); }
    // Nothing is left to do: exact, or the target error is met.
    [[nodiscard]] bool at_rest() const { return session_.at_rest(state_->budget); }
    [[nodiscard]] double stated_error() const { return session_.stated_error(); }
    // The image differs from the one encoded last.
    [[nodiscard]] bool image_changed() const { return image_changed_; }

    // The image as it stands, composed; the picture before must have been encoded.
    [[nodiscard]] Picture picture(const ImageStamp& stamp,
                                  const ImageForms& forms,
                                  int jpeg_quality);
    // What an image takes besides being lit, relit and composed: to wait for a thread, to be
    // encoded.
    void takes_besides(double milliseconds) { beside_ms_ = milliseconds; }

  private:
    void set_rig(const wire::RoomState& state,
                 const NamedEnvironments& environments,
                 std::vector<wire::ErrorMessage>& problems);
    void stepped(const engine::StepReport& step, Clock::duration spent);
    void compose(const ImageForms& forms, bool settled);
    // For relighting, of all the milliseconds that so many sessions take together.
    [[nodiscard]] relighting::Budget budget_for_relighting(std::size_t sessions) const;
    // Of that budget, what the slices since the state was set have left; all of it again once
    // they have left none.
    [[nodiscard]] relighting::Budget budget_for_slice(std::size_t sessions) const;

    const std::shared_ptr<const ServedScene> scene_;
    Metrics& metrics_;
    const double ceiling_ms_;
    engine::Session session_;
    std::shared_ptr<FrameComposer> composer_;

    std::optional<wire::RoomState> state_;
    NamedEnvironments environments_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
    DisplayTables displays_;

    // Running means of what is not relighting.
    double lighting_ms_ = 0;  // of a new state
    double compose_ms_ = 0;
    double beside_ms_ = 0;
    bool lighting_is_new_ = false;

    bool image_changed_ = true;
    // Since the state was set:
    double spent_ms_ = 0;
    std::uint32_t spent_columns_ = 0;
    // Since the last image:
    Clock::duration relight_time_{};
    std::uint32_t applied_ = 0;
    std::uint32_t remaining_ = 0;
};

}  // namespace relume::net
