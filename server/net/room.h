// People who see one session: its state, who watches, and when the next image is due.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/session_state.h"
#include "server/net/clock.h"
#include "server/net/environment_library.h"
#include "server/net/metrics.h"
#include "server/net/outbox.h"
#include "server/net/relighter.h"
#include "server/net/scene_library.h"
#include "server/net/worker_pool.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace relume::net {

struct RoomOptions {
    wire::Limits limits;
    // A state that nobody changed for so long gets its bit-exact image.
    std::chrono::milliseconds settle_delay{50};
    // While an image converges, the least time between two of them.
    std::chrono::milliseconds refinement_interval{33};
    int moving_jpeg_quality = 80;
    int converging_jpeg_quality = 95;
};

// Thread-safe. One slice of work runs at a time, on the workers; in between the room is in the
// workers' queue if there is something to do, and nowhere if there is not.
class Room : public WorkItem, public std::enable_shared_from_this<Room> {
  public:
    using SharedOutbox = std::shared_ptr<Outbox>;

    // `environment` is the one its state begins with.
    Room(std::string name,
         std::shared_ptr<const ServedScene> scene,
         std::shared_ptr<Environment> environment,
         const EnvironmentLibrary& library,
         WorkerPool& workers,
         Metrics& metrics,
         const RoomOptions& options);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const ServedScene& scene() const { return *scene_; }

    // Puts the snapshot into the outbox and, if the room rests, its latest image. False when
    // there are as many clients as the limits allow.
    [[nodiscard]] bool join(const SharedOutbox& viewer);
    void leave(const SharedOutbox& viewer);

    // Throws WireError; the state is then as before.
    void edit(const Outbox& author, const wire::Edit& edit, Clock::time_point read_at);
    void acknowledge(Outbox& viewer, std::uint64_t sequence);

    // Refuses edits from now on (shutting_down).
    void stop_edits();
    // Closes every viewer's connection once its outbox is empty.
    void close_all(wire::CloseCode code);
    // Edits wait for their first image.
    [[nodiscard]] bool has_pending_edit() const;
    // When its last client left; nothing while there is one.
    [[nodiscard]] std::optional<Clock::time_point> empty_since() const;

    void run() noexcept override;

  private:
    // What one slice of work needs to know, copied under the lock.
    struct Slice {
        bool state_changed = false;
        wire::SessionState state;  // set if it changed
        NamedEnvironments environments;
        std::uint64_t revision = 0;
        Clock::time_point edit_read_at;
        Clock::time_point settle_at;
        bool viewer_wants_moving = false;
        bool first_image_due = false;  // of an edit
        bool settled_image_due = false;
    };
    struct Result {
        std::vector<wire::ErrorMessage> problems;
        SharedImageFrame frame;
        bool at_rest = false;
    };

    [[nodiscard]] std::optional<Slice> begin_slice();
    [[nodiscard]] Result perform(const Slice& slice);
    [[nodiscard]] bool moving_image_is_due(const Slice& slice, Clock::time_point now) const;
    void end_slice(const Slice& slice, Result result);
    void fail_slice(const char* reason);
    void deliver_locked(const Slice& slice, const SharedImageFrame& frame);
    void queue_next_slice_locked(const Slice& slice, bool at_rest);
    void broadcast_viewers_locked();
    [[nodiscard]] std::string snapshot_text_locked() const;
    [[nodiscard]] NamedEnvironments resolve_locked(const wire::SessionState& next,
                                                   const nlohmann::json& patch) const;

    const std::string name_;
    const std::shared_ptr<const ServedScene> scene_;
    const EnvironmentLibrary& library_;
    WorkerPool& workers_;
    Metrics& metrics_;
    const RoomOptions options_;

    mutable std::mutex mutex_;
    wire::SessionState state_;
    NamedEnvironments environments_;
    std::uint64_t revision_ = 0;
    std::vector<SharedOutbox> viewers_;
    std::optional<Clock::time_point> empty_since_;
    bool stopped_ = false;
    bool running_ = false;
    std::optional<std::uint64_t> relit_revision_;
    // When the earliest edit was read that no slice has taken, and that one has taken but no
    // image shows; and the edit that the latest image answers.
    std::optional<Clock::time_point> untaken_edit_;
    std::optional<Clock::time_point> unshown_edit_;
    Clock::time_point answered_edit_;
    Clock::time_point last_edit_;
    SharedImageFrame settled_frame_;  // of the present revision only

    // Of the worker that runs the slice; `running_` keeps it alone.
    std::unique_ptr<Relighter> relighter_;
    std::uint64_t sequence_ = 0;
    Clock::time_point last_image_at_;
    double last_image_error_ = 0;
};

}  // namespace relume::net
