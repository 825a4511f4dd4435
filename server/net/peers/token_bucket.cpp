#include "server/net/peers/token_bucket.h"

#include <algorithm>

namespace relume::net {

TokenBucket::TokenBucket(double tokens_per_second, double burst, Clock::time_point now)
    : tokens_per_second_(tokens_per_second), burst_(burst), tokens_(burst), refilled_at_(now) {}

bool TokenBucket::take(Clock::time_point now, double tokens) {
    tokens = std::min(tokens, burst_);
    if (now > refilled_at_) {
        tokens_ = std::min(burst_, tokens_ + seconds(now - refilled_at_) * tokens_per_second_);
        refilled_at_ = now;
    }
    if (tokens_ < tokens) {
        return false;
    }
    tokens_ -= tokens;
    return true;
}

}  // namespace relume::net
