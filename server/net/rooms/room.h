// People who see one scene under one state: a document that they edit, an audience that
// watches, and a schedule of the work that brings the images.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/messages.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/frame_encoder.h"
#include "server/net/library/libraries.h"
#include "server/net/library/scene_library.h"
#include "server/net/rooms/audience.h"
#include "server/net/rooms/document.h"
#include "server/net/rooms/room_images.h"
#include "server/net/rooms/room_slice.h"
#include "server/net/rooms/schedule.h"
#include "server/net/rooms/worker_pool.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

namespace relume::net {

struct RoomOptions {
    wire::Limits limits;
    // Of `limits.clients_per_room`, those of one address.
    std::size_t clients_per_address = 32;
    // A state that nobody has changed for so long is settled, and gets its exact image.
    std::chrono::milliseconds settle_delay{50};
    ImageOptions images;
};

// The threads that rooms share.
struct RoomThreads {
    WorkerPool& workers;   // relight
    WorkerPool& encoders;  // encode
};

// Thread-safe: one mutex guards document, audience and schedule, and what is done under it is
// short. One slice of work runs at a time, on the workers; in between the room is in the
// workers' queue if there is something to do, and nowhere if there is not. Rooms of one scene
// that wait together are relit together. One picture at a time is with the encoders, while the
// next slice runs.
class Room : public WorkItem, public std::enable_shared_from_this<Room> {
  public:
    // `environment` is the one its state begins with.
    Room(std::string name,
         std::shared_ptr<const ServedScene> scene,
         std::shared_ptr<Environment> environment,
         const Libraries& libraries,
         RoomThreads threads,
         Metrics& metrics,
         const RoomOptions& options);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const ServedScene& scene() const { return *scene_; }

    // Puts the snapshot into the outbox and, if the room rests, its latest image. `address` is
    // the quota_key of who asks.
    [[nodiscard]] std::optional<Audience::Refusal> join(const Viewer& viewer,
                                                        const Audience::SharedOutbox& outbox,
                                                        const std::string& address);
    void leave(ViewerId viewer);

    // Throws wire::WireError; the state is then as before.
    void edit(ViewerId author, const wire::Edit& edit, Clock::time_point read_at);
    // Another map has taken its place behind the name. If the room is lit by it, it is relit,
    // and its viewers get a change that names the map again.
    void environment_replaced(const std::string& name);
    void acknowledge(ViewerId viewer, std::uint64_t sequence);

    // Refuses edits from now on (shutting_down).
    void stop_edits();
    // Closes every viewer's connection once its outbox is empty.
    void close_all(wire::CloseCode code);
    // Edits wait for their first image.
    [[nodiscard]] bool has_pending_edit() const;
    // When its last viewer left; nothing while there is one.
    [[nodiscard]] std::optional<Clock::time_point> empty_since() const;

    [[nodiscard]] const void* batch_key() const noexcept override { return scene_.get(); }
    void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept override;

  private:
    // A room's slice on its way through `run`.
    struct Running;
    // Encodes one picture and hands the frames over.
    class Encoding;

    [[nodiscard]] std::optional<RoomSlice> begin_slice();
    static void perform(std::span<Running> slices);
    // Brings into the slice whether the encoder is free and a viewer ready.
    void note_who_is_ready(RoomSlice& slice) const;
    void note_who_is_ready_locked(RoomSlice& slice) const;
    void end_slice(const RoomSlice& slice, SliceResult result);
    void slice_failed(const std::string& reason);
    // `since`: when the picture was done.
    void encode(const Picture& picture, Clock::time_point since) noexcept;
    void deliver(const ImageFrames& frames, Clock::time_point since);
    void encoding_failed(const std::string& reason);

    void tell_change_locked(const DocumentChange& change);
    void tell_failure_locked(const std::string& reason);
    [[nodiscard]] std::shared_ptr<const wire::Snapshot> snapshot_locked() const;
    [[nodiscard]] bool settled_image_is_current_locked() const;
    void queue_next_slice_locked();

    const std::string name_;
    const std::shared_ptr<const ServedScene> scene_;
    const Libraries libraries_;
    const RoomThreads threads_;
    Metrics& metrics_;
    const RoomOptions options_;

    mutable std::mutex mutex_;
    Document document_;
    Audience audience_;
    Schedule schedule_;
    std::uint64_t taken_revision_ = 0;  // of the state that the images are of
    // The latest settled image, as long as it shows the pixels of the document.
    SharedImageFrame settled_image_;
    bool stopped_ = false;

    RoomImages images_;     // of the worker that runs the slice
    FrameEncoder encoder_;  // of the encoder thread
};

}  // namespace relume::net
