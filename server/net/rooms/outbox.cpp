#include "server/net/rooms/outbox.h"

#include "protocol/wire/room_patch.h"

#include <utility>

namespace relume::net {

namespace {

// To these the client is told nothing more before.
bool closes_at_once(wire::CloseCode code) {
    return code != wire::CloseCode::shutting_down && code != wire::CloseCode::too_many_errors;
}

std::size_t lights_named_by(const nlohmann::json& patch) {
    const auto lights = patch.find("lights");
    return lights == patch.end() ? 0 : lights->size();
}

// By one patch or the other; both name some.
std::size_t lights_named_by_both(const nlohmann::json& a, const nlohmann::json& b) {
    std::size_t count = lights_named_by(a) + lights_named_by(b);
    const auto first = a.find("lights");
    const auto second = b.find("lights");
    if (first != a.end() && second != b.end()) {
        for (const auto& [id, light] : second->items()) {
            count -= first->contains(id) ? 1U : 0U;
        }
    }
    return count;
}

// What may become text without a lock.
struct ItemFromMessage {
    Outbox::Item operator()(const std::shared_ptr<const wire::Snapshot>& snapshot) const {
        return wire::text_from_message(*snapshot);
    }
    Outbox::Item operator()(SharedImageFrame& image) const { return std::move(image); }
    Outbox::Item operator()(const Outbox::Close& close) const { return close; }
    template <typename Message>
    Outbox::Item operator()(const Message& message) const {
        return wire::text_from_message(message);
    }
};

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

Outbox::Outbox(ImageInterest interest, const wire::Limits& limits)
    : interest_(interest),
      images_in_flight_(limits.images_in_flight),
      most_errors_(limits.errors_per_connection) {}

void Outbox::put_snapshot(std::shared_ptr<const wire::Snapshot> snapshot) {
    const WakeOnExit guard(*this);
    snapshot_ = std::move(snapshot);
    if (change_ && change_->edit_id) {
        change_->patch = nlohmann::json::object();
    } else {
        change_.reset();
    }
}

bool Outbox::put_change(const wire::Change& change) {
    const WakeOnExit guard(*this);
    if (!change_) {
        change_ = change;
        return true;
    }
    if (lights_named_by(change_->patch) + lights_named_by(change.patch) > kMaxMergedLights &&
        lights_named_by_both(change_->patch, change.patch) > kMaxMergedLights) {
        return false;
    }
    change_->revision = change.revision;
    change_->patch = wire::merge_patches(std::move(change_->patch), change.patch);
    if (change.edit_id) {
        change_->edit_id = change.edit_id;
    }
    return true;
}

void Outbox::confirm(std::uint64_t revision, std::uint64_t edit_id) {
    const WakeOnExit guard(*this);
    if (!change_) {
        change_.emplace().patch = nlohmann::json::object();
    }
    change_->revision = revision;
    change_->edit_id = edit_id;
}

void Outbox::put_error(const wire::ErrorMessage& error) {
    const WakeOnExit guard(*this);
    errors_.push_back(error);
    if (errors_.size() > most_errors_) {
        errors_.pop_front();
    }
}

void Outbox::put_viewers(std::uint32_t count) {
    const WakeOnExit guard(*this);
    viewers_ = count;
}

bool Outbox::put_image(SharedImageFrame image) {
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

void Outbox::choose_display(const wire::DisplayChoice& display) {
    const std::lock_guard lock(mutex_);
    display_ = display;
}

wire::DisplayChoice Outbox::display() const {
    const std::lock_guard lock(mutex_);
    return display_;
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
    std::optional<Message> message;
    {
        const std::lock_guard lock(mutex_);
        message = take_locked();
        taker_waits_ = !message;
    }
    if (!message) {
        return std::nullopt;
    }
    return std::visit(ItemFromMessage{}, *message);
}

std::optional<Outbox::Message> Outbox::take_locked() {
    if (closed_) {
        return std::nullopt;
    }
    if (close_ && closes_at_once(*close_)) {
        closed_ = true;
        return Close{*close_};
    }
    if (snapshot_) {
        return std::exchange(snapshot_, nullptr);
    }
    if (change_) {
        return *std::exchange(change_, std::nullopt);
    }
    if (!errors_.empty()) {
        wire::ErrorMessage error = std::move(errors_.front());
        errors_.pop_front();
        return error;
    }
    if (viewers_) {
        return wire::Viewers{.count = *std::exchange(viewers_, std::nullopt)};
    }
    if (image_ && unacknowledged_.size() < images_in_flight_) {
        unacknowledged_.push_back(image_->header.sequence);
        return std::exchange(image_, nullptr);
    }
    if (close_) {
        closed_ = true;
        return Close{*close_};
    }
    return std::nullopt;
}

}  // namespace relume::net
