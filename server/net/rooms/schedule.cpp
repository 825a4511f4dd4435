#include "server/net/rooms/schedule.h"

#include <utility>

namespace relume::net {

Schedule::Schedule(Clock::duration settle_delay, Clock::time_point now)
    : settle_delay_(settle_delay), answered_edit_(now), last_change_(now) {}

void Schedule::state_edited(wire::Stages stages, Clock::time_point read_at) {
    pace_.edit_came(read_at);
    state_changed(stages, read_at);
}

void Schedule::state_changed(wire::Stages stages, Clock::time_point at) {
    state_is_new_ = true;
    new_stages_ |= stages;
    last_change_ = at;
    if (!untaken_edit_) {
        untaken_edit_ = at;
    }
}

SliceOrder Schedule::begin_slice(Clock::time_point now) {
    is_running_ = true;
    SliceOrder order{.begun_at = now,
                     .takes_state = state_is_new_ && !step_is_unfinished_,
                     .stages = {},
                     .first_image_due = false,
                     .edit_read_at = {},
                     .settle_at = last_change_ + settle_delay_,
                     .overhead_ms = pace_.overhead_ms()};
    if (order.takes_state) {
        order.stages = std::exchange(new_stages_, {});
        state_is_new_ = false;
        if (!unshown_edit_) {
            unshown_edit_ = untaken_edit_;
        }
        untaken_edit_.reset();
    }
    order.first_image_due = unshown_edit_.has_value();
    order.edit_read_at = unshown_edit_.value_or(answered_edit_);
    return order;
}

void Schedule::end_slice(const SliceOrder& order,
                         const SliceOutcome& outcome,
                         Clock::time_point now) {
    is_running_ = false;
    pace_.slice_took(now - order.begun_at);
    is_at_rest_ = outcome.at_rest;
    step_is_unfinished_ = order.first_image_due && !outcome.step_is_complete;
    picture_waits_ = outcome.picture_waits;
    is_encoding_ = is_encoding_ || outcome.is_encoded;
    if (order.first_image_due && (outcome.is_encoded || outcome.is_shown)) {
        answered_edit_ = order.edit_read_at;
        unshown_edit_.reset();
        if (order.takes_state) {
            pace_.edit_waited(order.begun_at - order.edit_read_at);
        }
    }
}

void Schedule::slice_failed() {
    is_running_ = false;
    begin_anew();
}

void Schedule::encoding_failed() {
    is_encoding_ = false;
    begin_anew();
}

void Schedule::begin_anew() {
    step_is_unfinished_ = false;
    picture_waits_ = false;
    unshown_edit_.reset();
    state_is_new_ = true;
    new_stages_ = kAllStages;
}

void Schedule::encoding_ended() {
    is_encoding_ = false;
}

std::optional<Schedule::Due> Schedule::next_due(const Conditions& conditions,
                                                Clock::time_point now) const {
    if (is_running_) {
        return std::nullopt;
    }
    if (step_is_unfinished_) {
        return Due{.priority = WorkPriority::edit, .at = unshown_edit_.value_or(now)};
    }
    if (state_is_new_) {
        return Due{.priority = WorkPriority::edit, .at = untaken_edit_.value_or(now)};
    }
    if (picture_waits_ && !is_encoding_ && conditions.viewer_is_ready) {
        return Due{.priority = WorkPriority::edit, .at = unshown_edit_.value_or(now)};
    }
    if (!is_at_rest_) {
        return Due{.priority = WorkPriority::refinement, .at = pace_.time_to_refine(now)};
    }
    if (!conditions.settled_image_is_current && !is_encoding_) {
        return Due{.priority = WorkPriority::refinement, .at = last_change_ + settle_delay_};
    }
    return std::nullopt;
}

bool Schedule::has_pending_edit() const {
    return untaken_edit_ || unshown_edit_ || is_encoding_;
}

}  // namespace relume::net
