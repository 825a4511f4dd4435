// How long the images of a room take, and when a refinement of them should begin.
#pragma once

#include "protocol/base/timing/running_mean.h"
#include "server/net/base/clock.h"
#include "server/net/rooms/edit_rhythm.h"

namespace relume::net {

// Not thread-safe.
class RoomPace {
  public:
    void edit_came(Clock::time_point at) { rhythm_.edit_came(at); }
    // The time from reading an edit to the slice that made its picture.
    void edit_waited(Clock::duration time) { waiting_ms_.add(milliseconds(time)); }
    void slice_took(Clock::duration time) { slice_took_ = time; }
    // From a picture to its JPEG, waiting for the encoder included.
    void encoding_took(Clock::duration time) { encoding_ms_.add(milliseconds(time)); }

    // What an image takes from edit to JPEG outside its slices: waiting for a worker, encoding.
    [[nodiscard]] double overhead_ms() const {
        return waiting_ms_.mean() + encoding_ms_.mean();
    }
    // When a refinement should begin, so that the image of the next edit does not have to wait
    // for it.
    [[nodiscard]] Clock::time_point time_to_refine(Clock::time_point now) const {
        return rhythm_.time_for(slice_took_ + from_milliseconds(encoding_ms_.mean()), now);
    }

  private:
    EditRhythm rhythm_;
    Clock::duration slice_took_{};  // the last one
    timing::RunningMean waiting_ms_;
    timing::RunningMean encoding_ms_;
};

}  // namespace relume::net
