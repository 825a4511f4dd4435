#include "server/net/rooms/room.h"

#include "protocol/wire/room_patch.h"

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace relume::net {

Room::Room(std::string name,
           std::shared_ptr<const ServedScene> scene,
           std::shared_ptr<Environment> environment,
           const EnvironmentLibrary& library,
           RoomThreads threads,
           Metrics& metrics,
           const RoomOptions& options)
    : name_(std::move(name)),
      scene_(std::move(scene)),
      library_(library),
      threads_(threads),
      metrics_(metrics),
      options_(options),
      empty_since_(Clock::now()),
      answered_edit_(*empty_since_),
      last_edit_(*empty_since_),
      images_(scene_, metrics, options.images),
      encoder_(metrics) {
    state_.environment.name = environment->description().name;
    environments_.environment = std::move(environment);
}

bool Room::join(const SharedOutbox& viewer) {
    const std::lock_guard lock(mutex_);
    if (viewers_.size() >= options_.limits.clients_per_room) {
        return false;
    }
    viewers_.push_back(viewer);
    empty_since_.reset();
    metrics_.add_clients(1);
    viewer->put_snapshot(snapshot_locked());
    broadcast_viewers_locked();
    if (settled_frame_) {
        viewer->put_image(settled_frame_);
    } else {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit);
    }
    return true;
}

void Room::leave(const SharedOutbox& viewer) {
    const std::lock_guard lock(mutex_);
    if (std::erase(viewers_, viewer) == 0) {
        return;
    }
    metrics_.add_clients(-1);
    broadcast_viewers_locked();
    if (viewers_.empty()) {
        empty_since_ = Clock::now();
    }
}

std::shared_ptr<const wire::Snapshot> Room::snapshot_locked() const {
    return std::make_shared<const wire::Snapshot>(
        wire::Snapshot{.room = name_,
                       .scene = scene_->summary(),
                       .revision = revision_,
                       .state = state_,
                       .viewers = static_cast<std::uint32_t>(viewers_.size()),
                       .limits = options_.limits});
}

void Room::broadcast_viewers_locked() {
    for (const SharedOutbox& viewer : viewers_) {
        viewer->put_viewers(static_cast<std::uint32_t>(viewers_.size()));
    }
}

void Room::edit(const Outbox& author, const wire::Edit& edit, Clock::time_point read_at) {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        throw wire::WireError(wire::ErrorCode::shutting_down, "", "an edit",
                              "no edits while the server shuts down");
    }
    wire::RoomState next = state_;
    wire::Change change{.revision = revision_ + 1,
                        .patch = wire::apply_patch(next, edit.patch, options_.limits),
                        .edit_id = {}};
    environments_ = environments_after(environments_, next, change.patch, library_);
    state_ = std::move(next);
    revision_ = change.revision;
    settled_frame_.reset();
    last_edit_ = read_at;
    pace_.edit_came(read_at);
    if (!untaken_edit_) {
        untaken_edit_ = read_at;
    }
    metrics_.count_edit();
    std::shared_ptr<const wire::Snapshot> snapshot;
    for (const SharedOutbox& viewer : viewers_) {
        change.edit_id = viewer.get() == &author ? std::optional(edit.id) : std::nullopt;
        if (viewer->put_change(change)) {
            continue;
        }
        if (!snapshot) {
            snapshot = snapshot_locked();
        }
        viewer->put_snapshot(snapshot);
        if (change.edit_id) {
            viewer->confirm(change.revision, *change.edit_id);
        }
    }
    threads_.workers.enqueue(shared_from_this(), WorkPriority::edit, *untaken_edit_);
}

void Room::environment_replaced(const std::string& name) {
    const std::lock_guard lock(mutex_);
    nlohmann::json patch = nlohmann::json::object();
    if (state_.environment.name == name) {
        patch["environment"]["name"] = name;
    }
    if (state_.blend.name == name) {
        patch["blend"]["name"] = name;
    }
    if (patch.empty() || stopped_) {
        return;
    }
    environments_ = environments_after(environments_, state_, patch, library_);
    revision_ += 1;
    settled_frame_.reset();
    const Clock::time_point now = Clock::now();
    last_edit_ = now;
    if (!untaken_edit_) {
        untaken_edit_ = now;
    }
    for (const SharedOutbox& viewer : viewers_) {
        if (!viewer->put_change({.revision = revision_, .patch = patch, .edit_id = {}})) {
            viewer->put_snapshot(snapshot_locked());
        }
    }
    threads_.workers.enqueue(shared_from_this(), WorkPriority::edit, *untaken_edit_);
}

void Room::acknowledge(Outbox& viewer, std::uint64_t sequence) {
    viewer.acknowledge(sequence);
    const std::lock_guard lock(mutex_);
    // An edit's image may have been held back because nobody would have taken it.
    if (unshown_edit_ && !encoding_ && viewer.wants_moving_image()) {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit, *unshown_edit_);
    }
}

void Room::stop_edits() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
}

void Room::close_all(wire::CloseCode code) {
    const std::lock_guard lock(mutex_);
    for (const SharedOutbox& viewer : viewers_) {
        viewer->close(code);
    }
}

bool Room::has_pending_edit() const {
    const std::lock_guard lock(mutex_);
    return (untaken_edit_ || unshown_edit_ || encoding_) && !viewers_.empty();
}

std::optional<Clock::time_point> Room::empty_since() const {
    const std::lock_guard lock(mutex_);
    return empty_since_;
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

template <typename Work>
void Room::Turn::attempt(const Work& work) {
    if (!failure.empty()) {
        return;
    }
    try {
        work();
    } catch (const std::exception& reason) {
        failure = reason.what();
    }
}

void Room::run(std::span<const std::shared_ptr<WorkItem>> others) noexcept {
    std::vector<Turn> turns;
    const auto add = [&turns](Room& room) {
        if (std::optional<RoomSlice> slice = room.begin_slice()) {
            turns.push_back(
                {.room = &room, .slice = std::move(*slice), .result = {}, .failure = {}});
        }
    };
    add(*this);
    for (const std::shared_ptr<WorkItem>& other : others) {
        add(static_cast<Room&>(*other));  // who is of our company is a room of our scene
    }
    perform(turns);
    for (Turn& turn : turns) {
        if (turn.failure.empty()) {
            turn.room->end_slice(turn.slice, std::move(turn.result));
        } else {
            turn.room->images_.forget();
            turn.room->fail(turn.failure);
        }
    }
}

void Room::perform(std::span<Turn> turns) {
    tbb::parallel_for(std::size_t{0}, turns.size(), [&](std::size_t i) {
        Turn& turn = turns[i];
        turn.attempt([&] {
            // Times what it does: others' work must not slip in between.
            tbb::this_task_arena::isolate(
                [&] { turn.result.problems = turn.room->images_.begin(turn.slice); });
        });
    });
    std::vector<Relighter*> relighters;
    for (Turn& turn : turns) {
        const bool has_work = turn.failure.empty() && !turn.slice.only_picture_is_missing;
        Relighter* const next = has_work ? turn.room->images_.next_to_relight() : nullptr;
        if (next != nullptr) {
            relighters.push_back(next);
        }
    }
    try {
        Relighter::advance_together(relighters);
    } catch (const std::exception& reason) {
        for (Turn& turn : turns) {
            turn.failure = reason.what();
        }
    }
    tbb::parallel_for(std::size_t{0}, turns.size(), [&](std::size_t i) {
        Turn& turn = turns[i];
        turn.attempt([&] {
            tbb::this_task_arena::isolate([&] {
                auto problems = std::move(turn.result.problems);
                turn.room->look_who_is_ready(turn.slice);
                turn.result = turn.room->images_.end(turn.slice);
                turn.result.problems = std::move(problems);
            });
        });
    });
}

std::optional<RoomSlice> Room::begin_slice() {
    const std::lock_guard lock(mutex_);
    // Who runs looks again when it is done; without viewers the room stands still.
    if (running_ || viewers_.empty()) {
        return std::nullopt;
    }
    running_ = true;
    RoomSlice slice;
    slice.begun_at = Clock::now();
    slice.state_changed = relit_revision_ != revision_ && !image_in_the_making_;
    if (slice.state_changed) {
        slice.state = state_;
        slice.environments = environments_;
        relit_revision_ = revision_;
    }
    slice.revision = relit_revision_.value_or(revision_);
    if (!image_in_the_making_) {
        if (!unshown_edit_) {
            unshown_edit_ = untaken_edit_;
        }
        untaken_edit_.reset();
    }
    slice.first_image_due = unshown_edit_.has_value();
    slice.only_picture_is_missing = slice.first_image_due && !slice.state_changed &&
                                    !image_in_the_making_ && !encoding_ &&
                                    viewer_wants_moving_locked();
    slice.edit_read_at = unshown_edit_.value_or(answered_edit_);
    slice.settle_at = last_edit_ + options_.settle_delay;
    slice.settled_image_due = settled_frame_ == nullptr;
    slice.beside_ms = pace_.beside_slice_ms();
    return slice;
}

// Under one lock, for an image that an encoder has just handed over is in flight to a viewer.
void Room::look_who_is_ready(RoomSlice& slice) const {
    const std::lock_guard lock(mutex_);
    slice.encoder_is_free = !encoding_;
    slice.viewer_wants_moving = viewer_wants_moving_locked();
    for (const SharedOutbox& viewer : viewers_) {
        if (viewer->interest() == ImageInterest::all) {
            slice.moving_forms.add(viewer->display());
        } else if (viewer->interest() == ImageInterest::moving_float) {
            slice.moving_forms.half_planes = true;
        }
    }
}

bool Room::viewer_wants_moving_locked() const {
    return std::any_of(viewers_.begin(), viewers_.end(),
                       [](const SharedOutbox& viewer) { return viewer->wants_moving_image(); });
}

void Room::end_slice(const RoomSlice& slice, SliceResult result) {
    const std::lock_guard lock(mutex_);
    running_ = false;
    pace_.slice_took(Clock::now() - slice.begun_at);
    at_rest_ = result.at_rest;
    image_in_the_making_ = slice.first_image_due && !result.image_is_complete;
    for (const wire::ErrorMessage& problem : result.problems) {
        metrics_.count_error(problem.code);
        for (const SharedOutbox& viewer : viewers_) {
            viewer->put_error(problem);
        }
    }
    if (result.picture) {
        if (slice.first_image_due) {
            metrics_.observe_edit_to_image(result.picture->header.edit_to_image_ms / 1000.0);
            answered_edit_ = slice.edit_read_at;
            unshown_edit_.reset();
            if (slice.state_changed) {
                pace_.edit_waited(slice.begun_at - slice.edit_read_at);
            }
        }
        encoding_ = true;
        threads_.encoders.enqueue(
            std::make_shared<Encoding>(shared_from_this(), std::move(*result.picture)),
            slice.first_image_due ? WorkPriority::edit : WorkPriority::refinement,
            slice.edit_read_at);
    }
    queue_next_slice_locked();
}

void Room::encode(const Picture& picture, Clock::time_point since) noexcept {
    try {
        deliver(encoder_.encode(picture), since);
    } catch (const std::exception& reason) {
        {
            const std::lock_guard lock(mutex_);
            encoding_ = false;
        }
        fail(reason.what());
    }
}

void Room::deliver(const ImageFrames& frames, Clock::time_point since) {
    const std::lock_guard lock(mutex_);
    encoding_ = false;
    if (frames.settled && frames.half_planes->header.revision == revision_) {
        settled_frame_ = frames.half_planes;
    }
    if (!frames.settled) {
        pace_.encoding_took(Clock::now() - since);
    }
    for (const SharedOutbox& viewer : viewers_) {
        SharedImageFrame frame = frames.for_viewer(viewer->interest(), viewer->display());
        if (frame && viewer->put_image(std::move(frame))) {
            metrics_.count_dropped_image();
        }
    }
    if (unshown_edit_ && !viewers_.empty()) {
        // Its slice found the encoder busy.
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit, *unshown_edit_);
    } else if (!running_) {
        queue_next_slice_locked();
    }
}

void Room::queue_next_slice_locked() {
    if (viewers_.empty()) {
        return;
    }
    if (image_in_the_making_) {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit,
                                 unshown_edit_.value_or(Clock::now()));
    } else if (revision_ != relit_revision_) {
        threads_.workers.enqueue(shared_from_this(), WorkPriority::edit,
                                 untaken_edit_.value_or(Clock::now()));
    } else if (!at_rest_) {
        const Clock::time_point now = Clock::now();
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       pace_.time_to_refine(now) - now);
    } else if (!settled_frame_ && !encoding_) {
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       last_edit_ + options_.settle_delay - Clock::now());
    }
}

void Room::fail(const std::string& reason) {
    spdlog::error("room_failed room={} scene={} reason={:?}", name_, scene_->name, reason);
    const wire::ErrorMessage error{.code = wire::ErrorCode::internal,
                                   .message = "the image could not be computed",
                                   .path = "",
                                   .found = "a failure named in the server's log",
                                   .expected = "an image",
                                   .edit_id = {}};
    const std::lock_guard lock(mutex_);
    running_ = false;
    image_in_the_making_ = false;
    unshown_edit_.reset();
    metrics_.count_error(error.code);
    for (const SharedOutbox& viewer : viewers_) {
        viewer->put_error(error);
    }
    // The next edit begins afresh.
    relit_revision_.reset();
}

}  // namespace relume::net
