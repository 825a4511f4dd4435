// How long the images of a room take, and when a refinement of them should begin.
#pragma once

#include "server/net/base/clock.h"
#include "server/net/rooms/edit_rhythm.h"

namespace relume::net {

// Not thread-safe.
class RoomPace {
  public:
    void edit_came(Clock::time_point at) { rhythm_.edit_came(at); }
    // The time from reading an edit to the slice that made its picture.
    void edit_waited(Clock::duration time) { blend(waiting_ms_, time); }
    void slice_took(Clock::duration time) { slice_took_ = time; }
    // From a picture to its JPEG, waiting for the encoder included.
    void encoding_took(Clock::duration time) { blend(encoding_ms_, time); }

    // What an image takes from edit to JPEG outside its slices: waiting for a worker, encoding.
    [[nodiscard]] double beside_slice_ms() const { return waiting_ms_ + encoding_ms_; }
    // When a refinement should begin, so that the image of the next edit does not have to wait
    // for it.
    [[nodiscard]] Clock::time_point time_to_refine(Clock::time_point now) const {
        return rhythm_.time_for(slice_took_ + from_milliseconds(encoding_ms_), now);
    }

  private:
    static void blend(double& mean_ms, Clock::duration newest) {
        constexpr double kNewest = 0.2;
        mean_ms += kNewest * (milliseconds(newest) - mean_ms);
    }

    EditRhythm rhythm_;
    Clock::duration slice_took_{};  // the last one
    double waiting_ms_ = 0;
    double encoding_ms_ = 0;
};

}  // namespace relume::net
