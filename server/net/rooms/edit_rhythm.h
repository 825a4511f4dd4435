// How edits of a room follow one another, so that what may wait is not begun where the next one
// is about to come.
#pragma once

#include "server/net/base/clock.h"

namespace relume::net {

// Not thread-safe.
class EditRhythm {
  public:
    void edit_came(Clock::time_point at);

    // When work that makes nobody's edit visible, and takes about so long, should begin: at
    // once where it ends before the next edit of a drag, or there is no drag; else when that
    // edit has failed to come.
    [[nodiscard]] Clock::time_point time_for(Clock::duration work, Clock::time_point now) const;

  private:
    Clock::time_point last_;
    Clock::duration interval_{};  // of a drag, a running mean; 0 without one
};

}  // namespace relume::net
