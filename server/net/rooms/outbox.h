// What waits to be sent to one client. Its size is bounded whatever the client does.
//
// Nothing queues up behind a slow reader: unsent changes merge into one, which gives way to a
// snapshot before it grows large; of the viewer count only the last is kept, and the newest
// image replaces an unsent one. At most `images_in_flight` images are sent before the client
// acknowledges one. Messages become text when they are taken, without a lock held: who puts one
// never waits for that.
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

    // All else that a patch can name is of a fixed number.
    static constexpr std::size_t kMaxMergedLights = 256;

    Outbox(ImageInterest interest, const wire::Limits& limits);

    // Called (from any thread, without locks held) when there is something to take again after
    // `take` had nothing. Set before the outbox is shared.
    void set_wake(std::function<void()> wake) { wake_ = std::move(wake); }

    // In place of all changes so far. The id of an edit among them, which its author waits for,
    // is kept, as that of an empty change after the snapshot.
    void put_snapshot(std::shared_ptr<const wire::Snapshot> snapshot);
    // False, and nothing done, if the unsent change would then name more than kMaxMergedLights
    // lights: a snapshot is due. One change alone is always taken.
    [[nodiscard]] bool put_change(const wire::Change& change);
    // The edit of this id is in a snapshot that is put instead of its change.
    void confirm(std::uint64_t revision, std::uint64_t edit_id);
    // Of unsent ones the last `errors_per_connection` are kept.
    void put_error(const wire::ErrorMessage& error);
    void put_viewers(std::uint32_t count);
    // True if an unsent image was dropped for it.
    bool put_image(SharedImageFrame image);
    // Ends with this code; the first call counts. When the server shuts down, or there were
    // too many errors, all else that may be sent goes before.
    void close(wire::CloseCode code);

    // Image `sequence` and all before it have been received.
    void acknowledge(std::uint64_t sequence);
    // Whether an image of an unsettled state would be sent without waiting for an
    // acknowledgement.
    [[nodiscard]] bool wants_moving_image() const;
    [[nodiscard]] ImageInterest interest() const { return interest_; }

    // JPEGs that are made from now on have it. It is no edit: nothing is relit, and the image
    // of a state that rests, being linear, stands.
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
