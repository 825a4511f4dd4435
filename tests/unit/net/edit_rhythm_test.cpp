#include "server/net/rooms/edit_rhythm.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

using std::chrono::milliseconds;

const Clock::time_point kBegin = Clock::time_point() + std::chrono::hours(1);

// Edits every 20 ms, the last at `kBegin`.
EditRhythm drag() {
    EditRhythm rhythm;
    for (int i = -10; i <= 0; ++i) {
        rhythm.edit_came(kBegin + i * milliseconds(20));
    }
    return rhythm;
}

TEST(EditRhythm, LetsWorkBeginAtOnceWithoutADrag) {
    EditRhythm rhythm;
    EXPECT_EQ(rhythm.time_for(milliseconds(1000), kBegin), kBegin);
    rhythm.edit_came(kBegin);
    EXPECT_EQ(rhythm.time_for(milliseconds(1000), kBegin + milliseconds(1)),
              kBegin + milliseconds(1));
}

TEST(EditRhythm, LetsWorkBeginThatEndsBeforeTheNextEdit) {
    const Clock::time_point now = kBegin + milliseconds(5);
    EXPECT_EQ(drag().time_for(milliseconds(15), now), now);
}

TEST(EditRhythm, KeepsOtherWorkUntilTheNextEditIsOverdue) {
    const Clock::time_point now = kBegin + milliseconds(5);
    EXPECT_EQ(drag().time_for(milliseconds(16), now), kBegin + milliseconds(40));
    const Clock::time_point later = kBegin + milliseconds(41);
    EXPECT_EQ(drag().time_for(milliseconds(16), later), later);
}

TEST(EditRhythm, ForgetsADragAfterAPause) {
    EditRhythm rhythm = drag();
    const Clock::time_point again = kBegin + milliseconds(500);
    rhythm.edit_came(again);
    EXPECT_EQ(rhythm.time_for(milliseconds(50), again), again);
}

}  // namespace
}  // namespace relume::net
