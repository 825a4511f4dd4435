// A schedule alone, on a clock that the test sets.
#include "server/net/rooms/schedule.h"

#include <gtest/gtest.h>

namespace relume::net {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSettleDelay{50};
const Clock::time_point kBegin = Clock::time_point() + std::chrono::hours(1);
constexpr Schedule::Conditions kReady{.settled_image_is_current = false,
                                      .viewer_is_ready = true};
constexpr Schedule::Conditions kResting{.settled_image_is_current = true,
                                        .viewer_is_ready = true};

Clock::time_point at(int count) {
    return kBegin + milliseconds(count);
}

class ScheduleTest : public testing::Test {
  protected:
    // A slice without an edit to answer: what is left is relit.
    void rest(int begin) {
        const SliceOrder order = schedule_.begin_slice(at(begin));
        schedule_.end_slice(order, {.at_rest = true}, at(begin + 1));
    }
    void edit(int read_at, wire::Stages stages = wire::Stage::signal) {
        schedule_.state_edited(stages, at(read_at));
    }
    [[nodiscard]] std::optional<Schedule::Due> due(const Schedule::Conditions& conditions,
                                                   int now) const {
        return schedule_.next_due(conditions, at(now));
    }

    Schedule schedule_{kSettleDelay, kBegin};
};

TEST_F(ScheduleTest, BeginsWithAStateThatIsNewInAllStages) {
    ASSERT_TRUE(due(kReady, 0));
    const SliceOrder order = schedule_.begin_slice(at(0));
    EXPECT_TRUE(order.takes_state);
    EXPECT_EQ(order.stages, kAllStages);
    EXPECT_FALSE(order.first_image_due) << "nobody has edited";
}

TEST_F(ScheduleTest, NothingIsDueWhileASliceRunsNorAtRest) {
    const SliceOrder order = schedule_.begin_slice(at(0));
    edit(1);
    EXPECT_FALSE(due(kReady, 1));
    schedule_.end_slice(order, {.at_rest = true}, at(2));
    EXPECT_TRUE(due(kReady, 2));
    rest(2);
    EXPECT_FALSE(due(kResting, 1000));
}

TEST_F(ScheduleTest, AnEditIsDueSinceItWasReadAndEditsAreTakenTogether) {
    rest(0);
    edit(10, wire::Stage::signal);
    edit(12, wire::Stage::display);
    const auto next = due(kReady, 15);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->priority, WorkPriority::edit);
    EXPECT_EQ(next->at, at(10));
    const SliceOrder order = schedule_.begin_slice(at(16));
    EXPECT_EQ(order.stages, wire::Stage::signal | wire::Stage::display);
    EXPECT_TRUE(order.first_image_due);
    EXPECT_EQ(order.edit_read_at, at(10));
}

TEST_F(ScheduleTest, AStepKeepsTheStateItBeganWithUntilItIsComplete) {
    rest(0);
    edit(10);
    SliceOrder order = schedule_.begin_slice(at(10));
    schedule_.end_slice(order, {.step_is_complete = false}, at(26));
    edit(27, wire::Stage::view);
    order = schedule_.begin_slice(at(27));
    EXPECT_FALSE(order.takes_state);
    EXPECT_TRUE(order.first_image_due);
    EXPECT_EQ(order.edit_read_at, at(10));
    schedule_.end_slice(order, {.is_encoded = true}, at(40));
    schedule_.encoding_ended();
    order = schedule_.begin_slice(at(41));
    EXPECT_TRUE(order.takes_state);
    EXPECT_EQ(order.stages, wire::Stages(wire::Stage::view));
    EXPECT_EQ(order.edit_read_at, at(27));
}

TEST_F(ScheduleTest, APictureThatTheEncoderKeptWaitingIsDueWhenItIsFree) {
    rest(0);
    edit(10);
    SliceOrder order = schedule_.begin_slice(at(10));
    schedule_.end_slice(order, {.at_rest = true, .is_encoded = true}, at(12));
    edit(13);
    order = schedule_.begin_slice(at(13));
    schedule_.end_slice(order, {.at_rest = true, .picture_waits = true}, at(14));
    EXPECT_FALSE(due(kReady, 14)) << "the encoder is busy";
    EXPECT_TRUE(schedule_.has_pending_edit());
    schedule_.encoding_ended();
    EXPECT_EQ(due({.viewer_is_ready = false}, 15)->priority, WorkPriority::refinement);
    const auto next = due(kReady, 15);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->priority, WorkPriority::edit);
    EXPECT_EQ(next->at, at(13));
    order = schedule_.begin_slice(at(15));
    schedule_.end_slice(order, {.at_rest = true, .is_shown = true}, at(16));
    EXPECT_FALSE(schedule_.has_pending_edit());
}

TEST_F(ScheduleTest, AStateThatRestsForTheDelayIsSettled) {
    rest(0);
    edit(100);
    const SliceOrder order = schedule_.begin_slice(at(100));
    EXPECT_EQ(order.settle_at, at(100) + kSettleDelay);
    schedule_.end_slice(order, {.at_rest = true, .is_shown = true}, at(101));
    const auto next = due(kReady, 102);
    ASSERT_TRUE(next);
    EXPECT_EQ(next->priority, WorkPriority::refinement);
    EXPECT_EQ(next->at, at(100) + kSettleDelay);
    EXPECT_FALSE(due(kResting, 102));
}

TEST_F(ScheduleTest, AFailureIsNotTriedAgainByItselfButTakesTheWholeStateNextTime) {
    rest(0);
    edit(10, wire::Stage::display);
    static_cast<void>(schedule_.begin_slice(at(10)));
    schedule_.slice_failed();
    EXPECT_FALSE(schedule_.has_pending_edit());
    const SliceOrder order = schedule_.begin_slice(at(20));
    EXPECT_TRUE(order.takes_state);
    EXPECT_EQ(order.stages, kAllStages);
}

TEST_F(ScheduleTest, AnEncodingThatFailsLeavesTheSliceThatRunsAlone) {
    rest(0);
    edit(10);
    SliceOrder order = schedule_.begin_slice(at(10));
    schedule_.end_slice(order, {.is_encoded = true}, at(11));
    order = schedule_.begin_slice(at(12));
    schedule_.encoding_failed();
    EXPECT_TRUE(schedule_.is_running());
    EXPECT_FALSE(schedule_.is_encoding());
}

}  // namespace
}  // namespace relume::net
