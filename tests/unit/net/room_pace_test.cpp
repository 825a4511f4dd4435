#include "server/net/rooms/room_pace.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

using std::chrono::milliseconds;

const Clock::time_point kBegin = Clock::time_point() + std::chrono::hours(1);

TEST(RoomPace, LearnsWhatLiesBetweenAnEditAndItsImageBesideTheSlice) {
    RoomPace pace;
    EXPECT_EQ(pace.overhead_ms(), 0);
    for (int i = 0; i < 100; ++i) {
        pace.edit_waited(milliseconds(2));
        pace.encoding_took(milliseconds(5));
    }
    EXPECT_NEAR(pace.overhead_ms(), 7, 1e-6);
    pace.edit_waited(milliseconds(1000));
    EXPECT_LT(pace.overhead_ms(), 7 + 0.25 * 1000) << "one edit is no habit";
}

TEST(RoomPace, RefinesOnlyWhatIsEncodedBeforeTheNextEdit) {
    RoomPace pace;
    for (int i = -10; i <= 0; ++i) {
        pace.edit_came(kBegin + i * milliseconds(20));
    }
    pace.slice_took(milliseconds(8));
    const Clock::time_point now = kBegin + milliseconds(10);
    EXPECT_EQ(pace.time_to_refine(now), now);
    for (int i = 0; i < 100; ++i) {
        pace.encoding_took(milliseconds(3));
    }
    EXPECT_EQ(pace.time_to_refine(now), kBegin + milliseconds(40));
}

}  // namespace
}  // namespace relume::net
