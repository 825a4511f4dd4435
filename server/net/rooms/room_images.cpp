#include "server/net/rooms/room_images.h"

#include <utility>

namespace relume::net {

RoomImages::RoomImages(std::shared_ptr<const ServedScene> scene,
                       Metrics& metrics,
                       const ImageOptions& options)
    : scene_(std::move(scene)), metrics_(metrics), options_(options) {}

std::vector<wire::ErrorMessage> RoomImages::begin(const RoomSlice& slice) {
    if (!relighter_) {
        relighter_ = std::make_unique<Relighter>(scene_, metrics_, options_.slice_ceiling);
    }
    relighter_->takes_besides(slice.beside_ms);
    if (!slice.state_changed) {
        return {};
    }
    return relighter_->set_state(slice.state, slice.environments);
}

Relighter* RoomImages::next_to_relight() {
    return relighter_->at_rest() ? nullptr : relighter_.get();
}

SliceResult RoomImages::end(const RoomSlice& slice) {
    SliceResult result;
    result.at_rest = relighter_->at_rest();
    result.image_is_complete = relighter_->budget_is_spent();
    if (!slice.encoder_is_free) {
        return result;
    }
    ImageStamp stamp{.revision = slice.revision,
                     .sequence = sequence_ + 1,
                     .edit_read_at = slice.edit_read_at};
    const Clock::time_point now = Clock::now();
    if (result.at_rest && slice.settled_image_due && now >= slice.settle_at) {
        stamp.settled = true;
        result.picture = relighter_->picture(stamp, {.displays = {}, .half_planes = true}, 0);
    } else if (moving_image_is_due(slice, now)) {
        result.picture =
            relighter_->picture(stamp, slice.moving_forms,
                                slice.first_image_due ? options_.moving_jpeg_quality
                                                      : options_.converging_jpeg_quality);
    }
    if (result.picture) {
        ++sequence_;
        last_image_at_ = now;
        last_image_error_ = relighter_->stated_error();
    }
    return result;
}

bool RoomImages::moving_image_is_due(const RoomSlice& slice, Clock::time_point now) const {
    if (!slice.viewer_wants_moving || !relighter_->image_changed() ||
        relighter_->shows_state_before()) {
        return false;
    }
    if (slice.first_image_due) {
        return relighter_->budget_is_spent();
    }
    return relighter_->at_rest() || now - last_image_at_ >= options_.refinement_interval ||
           relighter_->stated_error() <= last_image_error_ / 2;
}

}  // namespace relume::net
