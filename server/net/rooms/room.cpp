#include "server/net/rooms/room.h"

#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <utility>
#include <vector>

namespace relume::net {

Room::Room(std::string name,
           std::shared_ptr<const ServedScene> scene,
           std::shared_ptr<Environment> environment,
           const Libraries& libraries,
           RoomThreads threads,
           Metrics& metrics,
           const RoomOptions& options)
    : name_(std::move(name)),
      scene_(std::move(scene)),
      libraries_(libraries),
      threads_(threads),
      metrics_(metrics),
      options_(options),
      document_(scene_->summary(), std::move(environment), scene_->loaded->curves()),
      audience_({.viewers = static_cast<std::size_t>(options.limits.clients_per_room),
                 .viewers_per_address = options.clients_per_address},
                metrics,
                Clock::now()),
      schedule_(options.settle_delay, Clock::now()),
      images_(scene_, metrics, options.images),
      encoder_(metrics) {}

std::optional<Audience::Refusal> Room::join(const Viewer& viewer,
                                            const Audience::SharedOutbox& outbox,
                                            const std::string& address) {
    const std::lock_guard lock(mutex_);
    if (const auto refusal = audience_.join(viewer, outbox, address)) {
        return refusal;
    }
    outbox->put_snapshot(snapshot_locked());
    audience_.tell_size();
    if (settled_image_is_current_locked()) {
        outbox->put_image(settled_image_);
    } else {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit);
    }
    return std::nullopt;
}

void Room::leave(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    audience_.leave(viewer, Clock::now());
    audience_.tell_size();
}

std::shared_ptr<const wire::Snapshot> Room::snapshot_locked() const {
    return std::make_shared<const wire::Snapshot>(
        wire::Snapshot{.room = name_,
                       .scene = scene_->summary(),
                       .revision = document_.revision(),
                       .state = document_.state(),
                       .viewers = audience_.size(),
                       .limits = options_.limits});
}

void Room::edit(ViewerId author, const wire::Edit& edit, Clock::time_point read_at) {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        throw wire::WireError(wire::ErrorCode::shutting_down, "", "an edit",
                              "no edits while the server shuts down");
    }
    const DocumentChange change = document_.edit(author, edit, options_.limits, libraries_);
    metrics_.count_edit();
    schedule_.state_edited(change.stages, read_at);
    tell_change_locked(change);
}

void Room::environment_replaced(const std::string& name) {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        return;
    }
    if (const auto change = document_.environment_replaced(name, libraries_.environments)) {
        schedule_.state_changed(change->stages, Clock::now());
        tell_change_locked(*change);
    }
}

void Room::tell_change_locked(const DocumentChange& change) {
    if (changes_pixels(change.stages)) {
        settled_image_.reset();
    }
    audience_.tell_change(change, [this] { return snapshot_locked(); });
    queue_next_slice_locked();
}

void Room::acknowledge(ViewerId viewer, std::uint64_t sequence) {
    const std::lock_guard lock(mutex_);
    if (const Audience::SharedOutbox outbox = audience_.outbox_of(viewer)) {
        outbox->acknowledge(sequence);
        if (schedule_.picture_waits()) {
            queue_next_slice_locked();
        }
    }
}

void Room::stop_edits() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
}

void Room::close_all(wire::CloseCode code) {
    const std::lock_guard lock(mutex_);
    audience_.close_all(code);
}

bool Room::has_pending_edit() const {
    const std::lock_guard lock(mutex_);
    return schedule_.has_pending_edit() && !audience_.empty();
}

std::optional<Clock::time_point> Room::empty_since() const {
    const std::lock_guard lock(mutex_);
    return audience_.empty_since();
}

class Room::Encoding : public WorkItem {
  public:
    Encoding(std::shared_ptr<Room> room, Picture picture)
        : room_(std::move(room)), picture_(std::move(picture)) {}
    void run(std::span<const std::shared_ptr<WorkItem>> /*others*/) noexcept override {
        room_->encode(picture_, since_);
    }

  private:
    const std::shared_ptr<Room> room_;
    const Picture picture_;
    const Clock::time_point since_ = Clock::now();
};

struct Room::Running {
    Room* room = nullptr;
    RoomSlice slice;
    SliceResult result;
    std::string failure;  // what went wrong, if anything

    // Does it, unless something has failed; notes what fails.
    template <typename Work>
    void attempt(const Work& work) {
        if (!failure.empty()) {
            return;
        }
        try {
            work();
        } catch (const std::exception& reason) {
            failure = reason.what();
        }
    }
};

void Room::run(std::span<const std::shared_ptr<WorkItem>> others) noexcept {
    std::vector<Running> slices;
    const auto add = [&slices](Room& room) {
        if (std::optional<RoomSlice> slice = room.begin_slice()) {
            slices.push_back(
                {.room = &room, .slice = std::move(*slice), .result = {}, .failure = {}});
        }
    };
    add(*this);
    for (const std::shared_ptr<WorkItem>& other : others) {
        add(static_cast<Room&>(*other));  // items of our key are rooms of our scene
    }
    perform(slices);
    for (Running& running : slices) {
        if (running.failure.empty()) {
            running.room->end_slice(running.slice, std::move(running.result));
        } else {
            running.room->images_.forget();
            running.room->slice_failed(running.failure);
        }
    }
}

// Three parts: states become light, each room's beside the others'; one sweep over the
// transport relights all; pictures are composed, each room's beside the others' again.
void Room::perform(std::span<Running> slices) {
    const auto each_alone = [slices](const auto& work) {
        tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t i) {
            slices[i].attempt([&] {
                // Times what it does: others' work must not slip in between.
                tbb::this_task_arena::isolate([&] { work(slices[i]); });
            });
        });
    };
    each_alone([](Running& running) {
        running.result.problems = running.room->images_.begin(running.slice);
    });
    std::vector<Relighter*> relighters;
    for (const Running& running : slices) {
        Relighter* const next = running.failure.empty()
                                    ? running.room->images_.next_to_relight(running.slice)
                                    : nullptr;
        if (next != nullptr) {
            relighters.push_back(next);
        }
    }
    try {
        Relighter::advance_together(relighters);
    } catch (const std::exception& reason) {
        for (Running& running : slices) {
            running.failure = reason.what();
        }
    }
    each_alone([](Running& running) {
        running.room->note_who_is_ready(running.slice);
        std::vector<wire::ErrorMessage> problems = std::move(running.result.problems);
        running.result = running.room->images_.end(running.slice);
        running.result.problems = std::move(problems);
    });
}

std::optional<RoomSlice> Room::begin_slice() {
    const std::lock_guard lock(mutex_);
    // Who runs looks again when it is done; without viewers the room stands still.
    if (schedule_.is_running() || audience_.empty()) {
        return std::nullopt;
    }
    RoomSlice slice;
    slice.order = schedule_.begin_slice(Clock::now());
    if (slice.order.takes_state) {
        slice.state = document_.state();
        slice.environments = document_.environments();
        slice.finishes = document_.finishes();
        taken_revision_ = document_.revision();
    }
    slice.revision = taken_revision_;
    slice.settled_image_due = !settled_image_is_current_locked();
    slice.earlier_settled = settled_image_;
    note_who_is_ready_locked(slice);
    return slice;
}

void Room::note_who_is_ready(RoomSlice& slice) const {
    const std::lock_guard lock(mutex_);
    note_who_is_ready_locked(slice);
}

// Under one lock, for an image that an encoder has just handed over is in flight to a viewer.
void Room::note_who_is_ready_locked(RoomSlice& slice) const {
    slice.encoder_is_free = !schedule_.is_encoding();
    slice.viewer_is_ready = audience_.wants_moving_image();
    slice.moving_forms = audience_.moving_forms();
}

void Room::end_slice(const RoomSlice& slice, SliceResult result) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    schedule_.end_slice(slice.order, result.outcome, now);
    for (const wire::ErrorMessage& problem : result.problems) {
        audience_.tell_problem(problem);
    }
    if (!result.outcome.at_rest) {
        settled_image_.reset();
    }
    if (slice.order.first_image_due && (result.picture || result.restamped)) {
        metrics_.observe_edit_to_image(seconds(now - slice.order.edit_read_at));
    }
    if (result.restamped) {
        if (result.restamped->header.revision >= document_.revision_of_pixels()) {
            settled_image_ = result.restamped;
        }
        audience_.show({.jpegs = {}, .half_planes = result.restamped, .settled = true});
    }
    if (result.picture) {
        threads_.encoders.enqueue(
            std::make_shared<Encoding>(shared_from_this(), std::move(*result.picture)),
            slice.order.first_image_due ? WorkPriority::edit : WorkPriority::refinement,
            slice.order.edit_read_at);
    }
    queue_next_slice_locked();
}

void Room::slice_failed(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    schedule_.slice_failed();
    tell_failure_locked(reason);
}

void Room::encode(const Picture& picture, Clock::time_point since) noexcept {
    try {
        deliver(encoder_.encode(picture), since);
    } catch (const std::exception& reason) {
        encoding_failed(reason.what());
    }
}

void Room::deliver(const ImageFrames& frames, Clock::time_point since) {
    const std::lock_guard lock(mutex_);
    schedule_.encoding_ended();
    if (!frames.settled) {
        schedule_.encoding_took(Clock::now() - since);
    } else if (frames.half_planes->header.revision >= document_.revision_of_pixels()) {
        settled_image_ = frames.half_planes;
    }
    audience_.show(frames);
    queue_next_slice_locked();
}

void Room::encoding_failed(const std::string& reason) {
    const std::lock_guard lock(mutex_);
    schedule_.encoding_failed();
    settled_image_.reset();
    tell_failure_locked(reason);
}

// Nothing is queued: the next edit, or who comes next, begins afresh.
void Room::tell_failure_locked(const std::string& reason) {
    spdlog::error("room_failed room={} scene={} reason={:?}", name_, scene_->name, reason);
    audience_.tell_problem({.code = wire::ErrorCode::internal,
                            .message = "the image could not be computed",
                            .path = "",
                            .found = "a failure named in the server's log",
                            .expected = "an image",
                            .edit_id = {}});
}

bool Room::settled_image_is_current_locked() const {
    return settled_image_ && settled_image_->header.revision == document_.revision();
}

void Room::queue_next_slice_locked() {
    if (audience_.empty()) {
        return;
    }
    const Clock::time_point now = Clock::now();
    const std::optional<Schedule::Due> due =
        schedule_.next_due({.settled_image_is_current = settled_image_is_current_locked(),
                            .viewer_is_ready = audience_.wants_moving_image()},
                           now);
    if (!due) {
        return;
    }
    if (due->priority == WorkPriority::edit) {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit, due->at);
    } else {
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       due->at - now);
    }
}

}  // namespace relume::net
