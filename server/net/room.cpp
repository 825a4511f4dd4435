#include "server/net/room.h"

#include "protocol/wire/session_patch.h"

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace relume::net {

Room::Room(std::string name,
           std::shared_ptr<const ServedScene> scene,
           std::shared_ptr<Environment> environment,
           const EnvironmentLibrary& library,
           WorkerPool& workers,
           Metrics& metrics,
           const RoomOptions& options)
    : name_(std::move(name)),
      scene_(std::move(scene)),
      library_(library),
      workers_(workers),
      metrics_(metrics),
      options_(options),
      empty_since_(Clock::now()),
      answered_edit_(*empty_since_),
      last_edit_(*empty_since_) {
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
    viewer->put_snapshot(snapshot_text_locked());
    broadcast_viewers_locked();
    if (settled_frame_) {
        viewer->put_image(settled_frame_);
    } else {
        workers_.enqueue(shared_from_this(), WorkPriority::edit);
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

std::string Room::snapshot_text_locked() const {
    const transport::TileGrid& image = scene_->engine->image();
    return wire::text_from_message(
        wire::Snapshot{.room = name_,
                       .scene = {.name = scene_->name,
                                 .width = image.width,
                                 .height = image.height,
                                 .face_resolution = scene_->engine->face_resolution()},
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

NamedEnvironments Room::resolve_locked(const wire::SessionState& next,
                                       const nlohmann::json& patch) const {
    const auto names_one = [&patch](const char* key) {
        const auto found = patch.find(key);
        return found != patch.end() && found->is_object() && found->contains("name");
    };
    const auto named = [this](const std::string& name, const char* path) {
        std::shared_ptr<Environment> environment = library_.find(name);
        if (!environment) {
            throw wire::WireError(wire::ErrorCode::unknown_name, path, name,
                                  "the name of an environment listed by /api/environments");
        }
        return environment;
    };
    NamedEnvironments resolved = environments_;
    // Naming an upload again takes its latest version.
    if (names_one("environment")) {
        resolved.environment = named(next.environment.name, "/environment/name");
    }
    if (!next.blend.name) {
        resolved.blend = nullptr;
    } else if (names_one("blend")) {
        resolved.blend = named(*next.blend.name, "/blend/name");
    }
    return resolved;
}

void Room::edit(const Outbox& author, const wire::Edit& edit, Clock::time_point read_at) {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        throw wire::WireError(wire::ErrorCode::shutting_down, "", "an edit",
                              "no edits while the server shuts down");
    }
    wire::SessionState next = state_;
    wire::Change change{.revision = revision_ + 1,
                        .patch = wire::apply_patch(next, edit.patch, options_.limits),
                        .edit_id = {}};
    environments_ = resolve_locked(next, change.patch);
    state_ = std::move(next);
    revision_ = change.revision;
    settled_frame_.reset();
    last_edit_ = read_at;
    if (!untaken_edit_) {
        untaken_edit_ = read_at;
    }
    metrics_.count_edit();
    for (const SharedOutbox& viewer : viewers_) {
        change.edit_id = viewer.get() == &author ? std::optional(edit.id) : std::nullopt;
        viewer->put_change(change);
    }
    workers_.enqueue(shared_from_this(), WorkPriority::edit);
}

void Room::acknowledge(Outbox& viewer, std::uint64_t sequence) {
    viewer.acknowledge(sequence);
    const std::lock_guard lock(mutex_);
    // An edit's image may have been held back because nobody would have taken it.
    if (unshown_edit_ && viewer.wants_moving_image()) {
        workers_.enqueue(shared_from_this(), WorkPriority::edit);
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
    return (untaken_edit_ || unshown_edit_) && !viewers_.empty();
}

std::optional<Clock::time_point> Room::empty_since() const {
    const std::lock_guard lock(mutex_);
    return empty_since_;
}

void Room::run() noexcept {
    try {
        if (const std::optional<Slice> slice = begin_slice()) {
            end_slice(*slice, perform(*slice));
        }
    } catch (const std::exception& failure) {
        fail_slice(failure.what());
    }
}

std::optional<Room::Slice> Room::begin_slice() {
    const std::lock_guard lock(mutex_);
    // Who runs looks again when it is done; without viewers the room stands still.
    if (running_ || viewers_.empty()) {
        return std::nullopt;
    }
    running_ = true;
    Slice slice;
    slice.revision = revision_;
    slice.state_changed = relit_revision_ != revision_;
    if (slice.state_changed) {
        slice.state = state_;
        slice.environments = environments_;
        relit_revision_ = revision_;
    }
    if (!unshown_edit_) {
        unshown_edit_ = untaken_edit_;
    }
    untaken_edit_.reset();
    slice.first_image_due = unshown_edit_.has_value();
    slice.edit_read_at = unshown_edit_.value_or(answered_edit_);
    slice.settle_at = last_edit_ + options_.settle_delay;
    slice.settled_image_due = settled_frame_ == nullptr;
    slice.viewer_wants_moving =
        std::any_of(viewers_.begin(), viewers_.end(),
                    [](const SharedOutbox& viewer) { return viewer->wants_moving_image(); });
    return slice;
}

Room::Result Room::perform(const Slice& slice) {
    Result result;
    if (!relighter_) {
        relighter_ = std::make_unique<Relighter>(scene_, metrics_);
    }
    if (slice.state_changed) {
        result.problems = relighter_->set_state(slice.state, slice.environments);
    }
    if (!relighter_->at_rest()) {
        relighter_->advance();
    }
    result.at_rest = relighter_->at_rest();
    const ImageStamp stamp{.revision = slice.revision,
                           .sequence = sequence_ + 1,
                           .edit_read_at = slice.edit_read_at};
    const Clock::time_point now = Clock::now();
    if (result.at_rest && slice.settled_image_due && now >= slice.settle_at) {
        result.frame = relighter_->encode_half(stamp);
    } else if (moving_image_is_due(slice, now)) {
        result.frame = relighter_->encode_jpeg(stamp, slice.first_image_due
                                                          ? options_.moving_jpeg_quality
                                                          : options_.converging_jpeg_quality);
    }
    if (result.frame) {
        ++sequence_;
        last_image_at_ = now;
        last_image_error_ = relighter_->stated_error();
    }
    return result;
}

bool Room::moving_image_is_due(const Slice& slice, Clock::time_point now) const {
    if (!slice.viewer_wants_moving || !relighter_->image_changed()) {
        return false;
    }
    return slice.first_image_due || relighter_->at_rest() ||
           now - last_image_at_ >= options_.refinement_interval ||
           relighter_->stated_error() <= last_image_error_ / 2;
}

void Room::end_slice(const Slice& slice, Result result) {
    const std::lock_guard lock(mutex_);
    running_ = false;
    for (const wire::ErrorMessage& problem : result.problems) {
        metrics_.count_error(problem.code);
        for (const SharedOutbox& viewer : viewers_) {
            viewer->put_error(problem);
        }
    }
    if (result.frame) {
        deliver_locked(slice, result.frame);
    }
    queue_next_slice_locked(slice, result.at_rest);
}

void Room::deliver_locked(const Slice& slice, const SharedImageFrame& frame) {
    if (slice.first_image_due) {
        metrics_.observe_edit_to_image(frame->header.edit_to_image_ms / 1000.0);
        answered_edit_ = slice.edit_read_at;
        unshown_edit_.reset();
    }
    if (frame->settled() && frame->header.revision == revision_) {
        settled_frame_ = frame;
    }
    for (const SharedOutbox& viewer : viewers_) {
        if (viewer->put_image(frame)) {
            metrics_.count_dropped_image();
        }
    }
}

void Room::queue_next_slice_locked(const Slice& slice, bool at_rest) {
    if (viewers_.empty()) {
        return;
    }
    if (revision_ != slice.revision) {
        workers_.enqueue(shared_from_this(), WorkPriority::edit);
    } else if (!at_rest) {
        workers_.enqueue(shared_from_this(), WorkPriority::refinement);
    } else if (!settled_frame_) {
        workers_.enqueue_after(shared_from_this(), WorkPriority::refinement,
                               slice.settle_at - Clock::now());
    }
}

void Room::fail_slice(const char* reason) {
    spdlog::error("room_failed room={} scene={} reason={:?}", name_, scene_->name, reason);
    const wire::ErrorMessage error{.code = wire::ErrorCode::internal,
                                   .message = "the image could not be computed",
                                   .path = "",
                                   .found = "a failure named in the server's log",
                                   .expected = "an image",
                                   .edit_id = {}};
    const std::lock_guard lock(mutex_);
    running_ = false;
    unshown_edit_.reset();
    metrics_.count_error(error.code);
    for (const SharedOutbox& viewer : viewers_) {
        viewer->put_error(error);
    }
    // The next edit begins afresh.
    relighter_.reset();
    relit_revision_.reset();
}

}  // namespace relume::net
