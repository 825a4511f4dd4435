#include "server/net/rooms/audience.h"

#include <algorithm>
#include <utility>

namespace relume::net {

Audience::Audience(const AudienceBounds& bounds, Metrics& metrics, Clock::time_point now)
    : most_(bounds.viewers),
      metrics_(metrics),
      by_address_(bounds.viewers_per_address),
      empty_since_(now) {}

std::optional<Audience::Refusal> Audience::join(const Viewer& viewer,
                                                const SharedOutbox& outbox,
                                                const std::string& address) {
    if (seats_.size() >= most_) {
        return Refusal::full;
    }
    AddressQuota::Place place = by_address_.take(address);
    if (!place) {
        return Refusal::full_for_address;
    }
    seats_.push_back({.viewer = viewer, .outbox = outbox, .place = std::move(place)});
    empty_since_.reset();
    metrics_.add_clients(1);
    return std::nullopt;
}

void Audience::leave(ViewerId viewer, Clock::time_point now) {
    if (std::erase_if(seats_, [&](const Seat& seat) { return seat.viewer.id == viewer; }) ==
        0) {
        return;
    }
    metrics_.add_clients(-1);
    if (seats_.empty()) {
        empty_since_ = now;
    }
}

Audience::SharedOutbox Audience::outbox_of(ViewerId viewer) const {
    const auto seat = std::find_if(seats_.begin(), seats_.end(), [&](const Seat& candidate) {
        return candidate.viewer.id == viewer;
    });
    return seat == seats_.end() ? nullptr : seat->outbox;
}

std::uint32_t Audience::size() const {
    return static_cast<std::uint32_t>(seats_.size());
}

bool Audience::wants_moving_image() const {
    return std::any_of(seats_.begin(), seats_.end(),
                       [](const Seat& seat) { return seat.outbox->wants_moving_image(); });
}

ImageForms Audience::moving_forms() const {
    ImageForms forms;
    for (const Seat& seat : seats_) {
        if (seat.outbox->interest() == ImageInterest::all) {
            forms.add(seat.outbox->display());
        } else if (seat.outbox->interest() == ImageInterest::moving_float) {
            forms.half_planes = true;
        }
    }
    return forms;
}

void Audience::tell_change(const DocumentChange& change,
                           const std::function<SharedSnapshot()>& snapshot) {
    SharedSnapshot whole;
    wire::Change message{.revision = change.revision, .patch = change.patch, .edit_id = {}};
    for (const Seat& seat : seats_) {
        message.edit_id = change.author == seat.viewer.id ? change.edit_id : std::nullopt;
        if (seat.outbox->put_change(message)) {
            continue;
        }
        if (!whole) {
            whole = snapshot();
        }
        seat.outbox->put_snapshot(whole);
        if (message.edit_id) {
            seat.outbox->confirm(message.revision, *message.edit_id);
        }
    }
}

void Audience::tell_size() {
    for (const Seat& seat : seats_) {
        seat.outbox->put_viewers(size());
    }
}

void Audience::tell_problem(const wire::ErrorMessage& problem) {
    metrics_.count_error(problem.code);
    for (const Seat& seat : seats_) {
        seat.outbox->put_error(problem);
    }
}

void Audience::show(const ImageFrames& frames) {
    for (const Seat& seat : seats_) {
        SharedImageFrame frame =
            frames.for_viewer(seat.outbox->interest(), seat.outbox->display());
        if (frame && seat.outbox->put_image(std::move(frame))) {
            metrics_.count_dropped_image();
        }
    }
}

void Audience::close_all(wire::CloseCode code) {
    for (const Seat& seat : seats_) {
        seat.outbox->close(code);
    }
}

}  // namespace relume::net
