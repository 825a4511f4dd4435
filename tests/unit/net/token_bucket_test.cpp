#include "server/net/peers/token_bucket.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

using std::chrono::milliseconds;

int taken(TokenBucket& bucket, Clock::time_point now, int tries) {
    int count = 0;
    for (int i = 0; i < tries; ++i) {
        count += bucket.take(now) ? 1 : 0;
    }
    return count;
}

TEST(TokenBucket, GivesTheBurstAtOnceAndNoMore) {
    const Clock::time_point start;
    TokenBucket bucket(10, 25, start);
    EXPECT_EQ(taken(bucket, start, 100), 25);
}

TEST(TokenBucket, RefillsAtItsRateUpToTheBurst) {
    const Clock::time_point start;
    TokenBucket bucket(10, 25, start);
    EXPECT_EQ(taken(bucket, start, 25), 25);
    EXPECT_EQ(taken(bucket, start + milliseconds(500), 100), 5);
    EXPECT_EQ(taken(bucket, start + milliseconds(100'000), 100), 25);
}

TEST(TokenBucket, OverALongTimeGivesRateTimesTime) {
    const Clock::time_point start;
    TokenBucket bucket(256, 512, start);
    int total = 0;
    for (int ms = 0; ms < 10'000; ++ms) {
        total += taken(bucket, start + milliseconds(ms), 3);
    }
    EXPECT_NEAR(total, 512 + 2560, 2);
}

TEST(TokenBucket, TimeThatStandsOrGoesBackGivesNothing) {
    const Clock::time_point start = Clock::time_point() + std::chrono::hours(1);
    TokenBucket bucket(1000, 1, start);
    EXPECT_TRUE(bucket.take(start));
    EXPECT_FALSE(bucket.take(start));
    EXPECT_FALSE(bucket.take(start - std::chrono::minutes(5)));
    EXPECT_FALSE(bucket.take(start));
    EXPECT_TRUE(bucket.take(start + milliseconds(1)));
}

}  // namespace
}  // namespace relume::net
