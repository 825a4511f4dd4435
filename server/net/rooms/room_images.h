// A room's images: its state relit, slice by slice, and which image is due when.
#pragma once

#include "server/net/base/metrics.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/relighter.h"
#include "server/net/rooms/room_slice.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace relume::net {

struct ImageOptions {
    // While an image converges, the least time between two of them.
    std::chrono::milliseconds refinement_interval{33};
    // The longest that a slice relights, whatever a room's budget: others wait no longer.
    std::chrono::milliseconds slice_ceiling{16};
    int moving_jpeg_quality = 80;
    int converging_jpeg_quality = 95;
};

// Not thread-safe: the room's slice has it to itself. A slice is `begin`, then relighting
// unless there is nothing to relight, then `end`.
class RoomImages {
  public:
    RoomImages(std::shared_ptr<const ServedScene> scene,
               Metrics& metrics,
               const ImageOptions& options);

    // Takes the slice's state over; what of it cannot be shown is told.
    [[nodiscard]] std::vector<wire::ErrorMessage> begin(const RoomSlice& slice);
    // Null when nothing is left to do, or an edit's image can be composed as it stands.
    [[nodiscard]] Relighter* next_to_relight(const RoomSlice& slice);
    // The picture that is due now, if one is and the encoder is free.
    [[nodiscard]] SliceResult end(const RoomSlice& slice);

    // Forgets the image after a failure; the next state begins afresh.
    void forget();

  private:
    [[nodiscard]] bool moving_image_is_due(const RoomSlice& slice, Clock::time_point now) const;
    void settle(const RoomSlice& slice, ImageStamp stamp, SliceResult& result);

    const std::shared_ptr<const ServedScene> scene_;
    Metrics& metrics_;
    const ImageOptions options_;
    std::unique_ptr<Relighter> relighter_;
    std::uint64_t sequence_ = 0;
    std::optional<std::uint64_t> settled_pixels_;  // Relighter::pixels of the settled image
    Clock::time_point last_image_at_;
    double last_image_error_ = 0;
};

}  // namespace relume::net
