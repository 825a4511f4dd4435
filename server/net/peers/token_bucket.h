// How often a peer may do a thing: a rate, and a burst above it.
#pragma once

#include "server/net/base/clock.h"

namespace relume::net {

// Starts full. Not thread-safe. Time is given, not taken, so that tests need not wait.
class TokenBucket {
  public:
    TokenBucket(double tokens_per_second, double burst, Clock::time_point now);

    // True, and so many tokens fewer, if there are as many; more than the burst are never asked
    // of it.
    [[nodiscard]] bool take(Clock::time_point now, double tokens = 1);

  private:
    double tokens_per_second_;
    double burst_;
    double tokens_;
    Clock::time_point refilled_at_;
};

}  // namespace relume::net
