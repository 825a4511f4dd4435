#include "server/net/outbox.h"

#include "protocol/wire/session_patch.h"

#include <utility>

namespace relume::net {

namespace {

// To these the client is told nothing more before.
bool closes_at_once(wire::CloseCode code) {
    return code != wire::CloseCode::shutting_down && code != wire::CloseCode::too_many_errors;
}

}  // namespace

// Holds the lock; wakes the taker, if it waits, after letting go of it.
class Outbox::WakeOnExit {
  public:
    explicit WakeOnExit(Outbox& outbox) : outbox_(outbox), lock_(outbox.mutex_) {}
    WakeOnExit(const WakeOnExit&) = delete;
    WakeOnExit& operator=(const WakeOnExit&) = delete;
    ~WakeOnExit() {
        const bool wake = std::exchange(outbox_.taker_waits_, false);
        lock_.unlock();
        if (wake && outbox_.wake_) {
            outbox_.wake_();
        }
    }

  private:
    Outbox& outbox_;
    std::unique_lock<std::mutex> lock_;
};

Outbox::Outbox(ImageInterest interest, std::size_t images_in_flight)
    : interest_(interest), images_in_flight_(images_in_flight) {}

void Outbox::put_snapshot(std::string text) {
    const WakeOnExit guard(*this);
    snapshot_ = std::move(text);
}

void Outbox::put_change(const wire::Change& change) {
    const WakeOnExit guard(*this);
    if (!change_) {
        change_ = change;
        return;
    }
    change_->revision = change.revision;
    change_->patch = wire::merge_patches(std::move(change_->patch), change.patch);
    if (change.edit_id) {
        change_->edit_id = change.edit_id;
    }
}

void Outbox::put_error(const wire::ErrorMessage& error) {
    const WakeOnExit guard(*this);
    if (errors_.size() == kMaxQueuedErrors) {
        if (!close_) {
            close_ = wire::CloseCode::too_many_errors;
        }
        return;
    }
    errors_.push_back(error);
}

void Outbox::put_viewers(std::uint32_t count) {
    const WakeOnExit guard(*this);
    viewers_ = count;
}

bool Outbox::put_image(SharedImageFrame image) {
    if (interest_ == ImageInterest::settled && !image->settled()) {
        return false;
    }
    const WakeOnExit guard(*this);
    const bool dropped = image_ != nullptr;
    image_ = std::move(image);
    return dropped;
}

void Outbox::close(wire::CloseCode code) {
    const WakeOnExit guard(*this);
    if (!close_) {
        close_ = code;
    }
}

void Outbox::acknowledge(std::uint64_t sequence) {
    const WakeOnExit guard(*this);
    while (!unacknowledged_.empty() && unacknowledged_.front() <= sequence) {
        unacknowledged_.pop_front();
    }
}

bool Outbox::wants_moving_image() const {
    if (interest_ == ImageInterest::settled) {
        return false;
    }
    const std::lock_guard lock(mutex_);
    const std::size_t waiting = image_ ? 1 : 0;
    return unacknowledged_.size() + waiting < images_in_flight_;
}

std::optional<Outbox::Item> Outbox::take() {
    const std::lock_guard lock(mutex_);
    std::optional<Item> item = take_locked();
    taker_waits_ = !item;
    return item;
}

std::optional<Outbox::Item> Outbox::take_locked() {
    if (closed_) {
        return std::nullopt;
    }
    if (close_ && closes_at_once(*close_)) {
        closed_ = true;
        return Item(Close{*close_});
    }
    if (snapshot_) {
        return Item(*std::exchange(snapshot_, std::nullopt));
    }
    if (change_) {
        return Item(wire::text_from_message(*std::exchange(change_, std::nullopt)));
    }
    if (!errors_.empty()) {
        const wire::ErrorMessage error = std::move(errors_.front());
        errors_.pop_front();
        return Item(wire::text_from_message(error));
    }
    if (viewers_) {
        return Item(wire::text_from_message(
            wire::Viewers{.count = *std::exchange(viewers_, std::nullopt)}));
    }
    if (image_ && unacknowledged_.size() < images_in_flight_) {
        unacknowledged_.push_back(image_->header.sequence);
        return Item(std::move(image_));
    }
    if (close_) {
        closed_ = true;
        return Item(Close{*close_});
    }
    return std::nullopt;
}

}  // namespace relume::net
