// A room's images: relights its state slice by slice, and says which image is due.
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
    // The longest that a slice relights, whatever a room's budget, so that other rooms get
    // their turn.
    std::chrono::milliseconds slice_ceiling{16};
    // Of columns of one room's materials that are edited beside its light.
    std::size_t material_bytes = materials::kUsualMaterialBytes;
    int moving_jpeg_quality = 80;
    int converging_jpeg_quality = 95;
};

// Not thread-safe: the room's one slice has it to itself. A slice calls `begin`, then relights
// unless there is nothing to relight, then calls `end`.
class RoomImages {
  public:
    RoomImages(std::shared_ptr<const ServedScene> scene,
               Metrics& metrics,
               const ImageOptions& options);

    // Takes over the slice's state. Returns what of it cannot be shown.
    [[nodiscard]] std::vector<wire::ErrorMessage> begin(const RoomSlice& slice);
    // What the slice relights; null where nothing is left to relight, or where an edit's image
    // can be composed from the sums as they are.
    [[nodiscard]] Relighter* next_to_relight(const RoomSlice& slice);
    // The result, with the picture that is due, if one is and the encoder is free.
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
