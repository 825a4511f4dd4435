// What waits to be sent to one viewer. Its size is bounded, whatever the viewer does.
//
// Nothing queues up behind a slow reader. Unsent changes merge into one, and a snapshot takes
// its place before it grows large. The last viewer count and the newest image replace unsent
// ones. At most `images_in_flight` images are sent before the viewer acknowledges one. A
// message becomes text when it is taken, outside the lock: whoever puts one never waits for
// that.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/messages.h"
#include "server/net/images/image_frame.h"
#include "server/net/images/image_interest.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

namespace relume::net {

// Thread-safe. Rooms put, one connection takes.
class Outbox {
  public:
    // The last item of all.
    struct Close {
        wire::CloseCode code;
    };
    using Item = std::variant<std::string, SharedImageFrame, Close>;

    // The bound of a merged change: all that a patch can name besides lights is fixed in
    // number.
    static constexpr std::size_t kMaxMergedLights = 256;

    Outbox(ImageInterest interest, const wire::Limits& limits);

    // `wake` is called, from any thread and without a lock held, when there is something to
    // take after `take` had nothing. Set it before the outbox is shared.
    void set_wake(std::function<void()> wake) { wake_ = std::move(wake); }

    // The snapshot replaces all unsent changes. If one of them answers an edit of this viewer,
    // an empty change with the edit's id follows the snapshot.
    void put_snapshot(std::shared_ptr<const wire::Snapshot> snapshot);
    // Returns false and does nothing if the merged change would name more than
    // kMaxMergedLights lights: a snapshot is due then. One change alone is always taken.
    [[nodiscard]] bool put_change(const wire::Change& change);
    // Tells the author that a snapshot which was put instead of a change holds the edit.
    void confirm(std::uint64_t revision, std::uint64_t edit_id);
    // The last `errors_per_connection` unsent errors are kept.
    void put_error(const wire::ErrorMessage& error);
    void put_viewers(std::uint32_t count);
    // True if an unsent image was dropped for it.
    bool put_image(SharedImageFrame image);
    // Ends the outbox with this code; the first call counts. When the server shuts down, or
    // the viewer made too many errors, whatever else may be sent goes before.
    void close(wire::CloseCode code);

    // Image `sequence` and all before it have been received.
    void acknowledge(std::uint64_t sequence);
    // Whether an image of an unsettled state would be sent without waiting for an
    // acknowledgement.
    [[nodiscard]] bool wants_moving_image() const;
    [[nodiscard]] ImageInterest interest() const { return interest_; }

    // JPEGs that are made for this viewer from now on have this display. It is no edit:
    // nothing is relit, and the settled image, being linear, stands.
    void choose_display(const wire::DisplayChoice& display);
    [[nodiscard]] wire::DisplayChoice display() const;

    // The next thing to send: snapshot, change, errors, viewers, image, close.
    [[nodiscard]] std::optional<Item> take();

  private:
    using Message = std::variant<std::shared_ptr<const wire::Snapshot>,
                                 wire::Change,
                                 wire::ErrorMessage,
                                 wire::Viewers,
                                 SharedImageFrame,
                                 Close>;
    class WakeOnExit;
    [[nodiscard]] std::optional<Message> take_locked();

    const ImageInterest interest_;
    const std::size_t images_in_flight_;
    const std::size_t most_errors_;
    std::function<void()> wake_;

    mutable std::mutex mutex_;
    std::shared_ptr<const wire::Snapshot> snapshot_;
    std::optional<wire::Change> change_;
    std::deque<wire::ErrorMessage> errors_;
    std::optional<std::uint32_t> viewers_;
    wire::DisplayChoice display_;
    SharedImageFrame image_;
    std::deque<std::uint64_t> unacknowledged_;  // sequence numbers, ascending
    std::optional<wire::CloseCode> close_;
    bool closed_ = false;  // `Close` has been taken
    bool taker_waits_ = false;
};

}  // namespace relume::net
