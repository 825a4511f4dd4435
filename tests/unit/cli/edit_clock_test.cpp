#include "client/cli/edit_clock.h"

#include <gtest/gtest.h>

namespace relume::cli {
namespace {

Clock::time_point at(int milliseconds) {
    return Clock::time_point{} + std::chrono::milliseconds(milliseconds);
}

using Milliseconds = std::vector<double>;

TEST(EditClock, TimesAnEditToTheFirstImageThatHoldsIt) {
    EditClock clock;
    clock.edit_sent(1, at(100));
    EXPECT_EQ(clock.image_received(50, at(110)),
              Milliseconds{});  // its revision is not known yet
    clock.change_received(1, 51);
    EXPECT_EQ(clock.image_received(50, at(120)), Milliseconds{});
    EXPECT_EQ(clock.image_received(51, at(130)), Milliseconds{30});
    EXPECT_EQ(clock.image_received(51, at(140)), Milliseconds{});
}

TEST(EditClock, OneChangeMayHoldSeveralEditsAndOneImageSeveralChanges) {
    EditClock clock;
    for (int id = 1; id <= 4; ++id) {
        clock.edit_sent(static_cast<std::uint64_t>(id), at(10 * id));
    }
    clock.change_received(3, 7);
    clock.change_received(4, 8);
    EXPECT_EQ(clock.image_received(7, at(100)), (Milliseconds{90, 80, 70}));
    EXPECT_EQ(clock.image_received(9, at(110)), Milliseconds{70});
}

TEST(EditClock, ARefusedEditIsNeverShown) {
    EditClock clock;
    clock.edit_sent(1, at(0));
    clock.edit_sent(2, at(0));
    clock.edit_refused(1);
    clock.change_received(2, 5);
    EXPECT_EQ(clock.image_received(5, at(8)), Milliseconds{8});
}

}  // namespace
}  // namespace relume::cli
