#include "server/net/rooms/edit_rhythm.h"

namespace relume::net {
namespace {

// Edits further apart are no drag.
constexpr Clock::duration kLongestInterval = std::chrono::milliseconds(100);
constexpr int kNewest = 4;  // a quarter of the mean

}  // namespace

void EditRhythm::edit_came(Clock::time_point at) {
    const Clock::duration gap = at - last_;
    last_ = at;
    if (gap > kLongestInterval) {
        interval_ = {};
    } else {
        interval_ =
            interval_ == Clock::duration{} ? gap : interval_ + (gap - interval_) / kNewest;
    }
}

Clock::time_point EditRhythm::time_for(Clock::duration work, Clock::time_point now) const {
    const Clock::time_point expected = last_ + interval_;
    const Clock::time_point overdue = expected + interval_;
    return now + work <= expected || now >= overdue ? now : overdue;
}

}  // namespace relume::net
