// People who see one session: its state, who watches, and when the next image is due.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/room_state.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/frame_encoder.h"
#include "server/net/library/environment_library.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/named_environments.h"
#include "server/net/rooms/outbox.h"
#include "server/net/rooms/room_images.h"
#include "server/net/rooms/room_pace.h"
#include "server/net/rooms/room_slice.h"
#include "server/net/rooms/worker_pool.h"

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
    ImageOptions images;
};

// The threads that rooms share.
struct RoomThreads {
    WorkerPool& workers;   // relight
    WorkerPool& encoders;  // encode
};

// Thread-safe. One slice of work runs at a time, on the workers; in between the room is in the
// workers' queue if there is something to do, and nowhere if there is not. Rooms of one scene
// that wait together are relit together. One image at a time is with the encoders, while the
// next slice runs.
class Room : public WorkItem, public std::enable_shared_from_this<Room> {
  public:
    using SharedOutbox = std::shared_ptr<Outbox>;

    // `environment` is the one its state begins with.
    Room(std::string name,
         std::shared_ptr<const ServedScene> scene,
         std::shared_ptr<Environment> environment,
         const EnvironmentLibrary& library,
         RoomThreads threads,
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
    // The map behind a name has changed: who is lit by it is relit. Viewers get a change that
    // names it again.
    void environment_replaced(const std::string& name);
    void acknowledge(Outbox& viewer, std::uint64_t sequence);

    // Refuses edits from now on (shutting_down).
    void stop_edits();
    // Closes every viewer's connection once its outbox is empty.
    void close_all(wire::CloseCode code);
    // Edits wait for their first image.
    [[nodiscard]] bool has_pending_edit() const;
    // When its last client left; nothing while there is one.
    [[nodiscard]] std::optional<Clock::time_point> empty_since() const;

    [[nodiscard]] const void* company() const noexcept override { return scene_.get(); }
    void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept override;

  private:
    // A room's slice on its way through `run`.
    struct Turn {
        Room* room = nullptr;
        RoomSlice slice;
        SliceResult result;
        std::string failure;  // what went wrong, if anything

        // Does it, unless something has failed; notes what fails.
        template <typename Work>
        void attempt(const Work& work);
    };
    // Encodes one picture and hands the frame over.
    class Encoding;

    [[nodiscard]] std::optional<RoomSlice> begin_slice();
    static void perform(std::span<Turn> turns);
    void look_who_is_ready(RoomSlice& slice) const;
    [[nodiscard]] bool viewer_wants_moving_locked() const;
    void end_slice(const RoomSlice& slice, SliceResult result);
    // `since`: when the picture was done.
    void encode(const Picture& picture, Clock::time_point since) noexcept;
    void deliver(const ImageFrames& frames, Clock::time_point since);
    void fail(const std::string& reason);
    void queue_next_slice_locked();
    void broadcast_viewers_locked();
    [[nodiscard]] std::shared_ptr<const wire::Snapshot> snapshot_locked() const;

    const std::string name_;
    const std::shared_ptr<const ServedScene> scene_;
    const EnvironmentLibrary& library_;
    const RoomThreads threads_;
    Metrics& metrics_;
    const RoomOptions options_;

    mutable std::mutex mutex_;
    wire::RoomState state_;
    NamedEnvironments environments_;
    std::uint64_t revision_ = 0;
    std::vector<SharedOutbox> viewers_;
    std::optional<Clock::time_point> empty_since_;
    bool stopped_ = false;
    bool running_ = false;
    bool encoding_ = false;
    bool at_rest_ = false;  // as the last slice left it
    // An edit's image has had a part of its budget: it keeps the state it began with, and those
    // of edits that have come since wait for it.
    bool image_in_the_making_ = false;
    std::optional<std::uint64_t> relit_revision_;
    // When the earliest edit was read that no slice has taken, and that one has taken but no
    // picture shows; and the edit that the latest picture answers.
    std::optional<Clock::time_point> untaken_edit_;
    std::optional<Clock::time_point> unshown_edit_;
    Clock::time_point answered_edit_;
    Clock::time_point last_edit_;
    SharedImageFrame settled_frame_;  // of the present revision only
    RoomPace pace_;

    RoomImages images_;     // of the worker that runs the slice; `running_` keeps it alone
    FrameEncoder encoder_;  // of the encoder thread; `encoding_` keeps it alone
};

}  // namespace relume::net
