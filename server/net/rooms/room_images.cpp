#include "server/net/rooms/room_images.h"

#include <utility>

namespace relume::net {

RoomImages::RoomImages(std::shared_ptr<const ServedScene> scene,
                       Metrics& metrics,
                       const ImageOptions& options)
    : scene_(std::move(scene)), metrics_(metrics), options_(options) {}

std::vector<wire::ErrorMessage> RoomImages::begin(const RoomSlice& slice) {
    if (!relighter_) {
        relighter_ = std::make_unique<Relighter>(scene_, metrics_, options_.slice_ceiling,
                                                 options_.material_bytes);
    }
    relighter_->set_overhead(slice.order.overhead_ms);
    if (!slice.order.takes_state) {
        return {};
    }
    return relighter_->set_state(slice.state, slice.environments, slice.finishes,
                                 slice.order.stages);
}

Relighter* RoomImages::next_to_relight(const RoomSlice& slice) {
    const bool is_composed_at_once = slice.order.first_image_due && slice.encoder_is_free &&
                                     slice.viewer_is_ready &&
                                     moving_image_is_due(slice, slice.order.begun_at);
    return relighter_->at_rest() || is_composed_at_once ? nullptr : relighter_.get();
}

SliceResult RoomImages::end(const RoomSlice& slice) {
    SliceResult result;
    result.outcome.at_rest = relighter_->at_rest();
    result.outcome.step_is_complete = relighter_->step_is_complete();
    ImageStamp stamp{.revision = slice.revision,
                     .sequence = sequence_ + 1,
                     .edit_read_at = slice.order.edit_read_at};
    const Clock::time_point now = Clock::now();
    if (result.outcome.at_rest && slice.settled_image_due && now >= slice.order.settle_at) {
        if (slice.encoder_is_free) {
            settle(slice, stamp, result);
        }
    } else if (moving_image_is_due(slice, now)) {
        if (slice.encoder_is_free && slice.viewer_is_ready) {
            result.picture = relighter_->picture(stamp, slice.moving_forms,
                                                 slice.order.first_image_due
                                                     ? options_.moving_jpeg_quality
                                                     : options_.converging_jpeg_quality);
        } else {
            result.outcome.picture_waits = slice.order.first_image_due;
        }
    }
    result.outcome.is_encoded = result.picture.has_value();
    result.outcome.is_shown = result.restamped != nullptr;
    if (result.picture) {
        last_image_at_ = now;
        last_image_error_ = relighter_->stated_error();
    }
    if (result.picture || result.restamped) {
        ++sequence_;
    }
    return result;
}

void RoomImages::settle(const RoomSlice& slice, ImageStamp stamp, SliceResult& result) {
    stamp.settled = true;
    if (slice.earlier_settled && settled_pixels_ == relighter_->pixels()) {
        result.restamped = restamped(*slice.earlier_settled, stamp);
    } else {
        result.picture = relighter_->picture(stamp, {.displays = {}, .half_planes = true}, 0);
        settled_pixels_ = relighter_->pixels();
    }
}

void RoomImages::forget() {
    relighter_.reset();
    settled_pixels_.reset();
}

bool RoomImages::moving_image_is_due(const RoomSlice& slice, Clock::time_point now) const {
    if (!relighter_->image_changed() || relighter_->shows_state_before()) {
        return false;
    }
    if (slice.order.first_image_due) {
        return relighter_->step_is_complete();
    }
    return relighter_->at_rest() || now - last_image_at_ >= options_.refinement_interval ||
           relighter_->stated_error() <= last_image_error_ / 2;
}

}  // namespace relume::net
