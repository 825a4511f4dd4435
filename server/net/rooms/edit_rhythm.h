// The rhythm in which edits of a room follow one another. By it a room avoids to begin work
// that can wait when the next edit is about to come.
#pragma once

#include "server/net/base/clock.h"

namespace relume::net {

// Not thread-safe.
class EditRhythm {
  public:
    void edit_came(Clock::time_point at);

    // When work that shows nobody's edit, and takes about so long, should begin: at once where
    // nobody drags or where it ends before the next edit is expected, otherwise when that edit
    // is overdue.
    [[nodiscard]] Clock::time_point time_for(Clock::duration work, Clock::time_point now) const;

  private:
    Clock::time_point last_;
    Clock::duration interval_{};  // of a drag, a running mean; 0 without one
};

}  // namespace relume::net
