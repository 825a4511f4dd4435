// What one room computes: its state as light, the light through the engine, the image encoded.
#pragma once

#include "protocol/wire/half_image.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/session_state.h"
#include "server/engine/session.h"
#include "server/light/light_cubemap.h"
#include "server/light/light_rig.h"
#include "server/net/clock.h"
#include "server/net/display_table.h"
#include "server/net/environment.h"
#include "server/net/frame_composer.h"
#include "server/net/image_frame.h"
#include "server/net/jpeg_encoder.h"
#include "server/net/metrics.h"
#include "server/net/scene_library.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace relume::net {

// The environments that a state names. `blend` is null when it names none.
struct NamedEnvironments {
    std::shared_ptr<Environment> environment;
    std::shared_ptr<Environment> blend;

    friend bool operator==(const NamedEnvironments&, const NamedEnvironments&) = default;
};

// Which edit an image answers, and how long that took.
struct ImageStamp {
    std::uint64_t revision = 0;
    std::uint64_t sequence = 0;
    Clock::time_point edit_read_at;
};

// Not thread-safe: a room calls it from one worker at a time.
class Relighter {
  public:
    Relighter(std::shared_ptr<const ServedScene> scene, Metrics& metrics);

    // What the image is to show from now on; only what differs from before is computed anew. An
    // environment that cannot be decoded is black, and named in the result.
    std::vector<wire::ErrorMessage> set_state(const wire::SessionState& state,
                                              const NamedEnvironments& environments);

    // One image's worth of relighting: the state's milliseconds less what lighting, composing
    // and encoding have been taking, so that the image is ready when they are over.
    void advance();
    // Nothing is left to do: exact, or the target error is met.
    [[nodiscard]] bool at_rest() const { return session_.at_rest(state_->budget); }
    [[nodiscard]] double stated_error() const { return session_.stated_error(); }
    // The image differs from the one encoded last.
    [[nodiscard]] bool image_changed() const { return image_changed_; }

    [[nodiscard]] SharedImageFrame encode_jpeg(const ImageStamp& stamp, int quality);
    [[nodiscard]] SharedImageFrame encode_half(const ImageStamp& stamp);

  private:
    void set_rig(const wire::SessionState& state,
                 const NamedEnvironments& environments,
                 std::vector<wire::ErrorMessage>& problems);
    // Milliseconds of both are measured in `encode`.
    template <typename AppendPayload>
    [[nodiscard]] SharedImageFrame encode(const ImageStamp& stamp,
                                          wire::ImageEncoding encoding,
                                          const AppendPayload& append_payload);
    void compose_if_changed();
    [[nodiscard]] wire::Budget budget_for_relighting() const;

    const std::shared_ptr<const ServedScene> scene_;
    Metrics& metrics_;
    engine::Session session_;
    FrameComposer composer_;
    JpegEncoder jpeg_;
    wire::HalfImageEncoder half_;

    std::optional<wire::SessionState> state_;
    NamedEnvironments environments_;
    light::LightRig rig_;
    light::LightCubemap cubemap_;
    std::vector<float> coefficients_;
    std::optional<DisplayTable> display_;
    std::vector<std::uint8_t> codes_;

    // Running means of what is not relighting.
    double lighting_ms_ = 0;  // of a new state
    double picture_ms_ = 0;   // composing and encoding
    bool lighting_is_new_ = false;

    bool composed_ = false;
    bool image_changed_ = true;
    Clock::duration compose_time_{};
    // Since the last image:
    Clock::duration relight_time_{};
    std::uint32_t applied_ = 0;
    std::uint32_t remaining_ = 0;
};

}  // namespace relume::net
