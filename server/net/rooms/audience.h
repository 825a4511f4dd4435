// Who watches a room, and what is told to them.
#pragma once

#include "protocol/wire/errors.h"
#include "protocol/wire/messages.h"
#include "server/net/base/clock.h"
#include "server/net/base/metrics.h"
#include "server/net/images/image_forms.h"
#include "server/net/images/image_frame.h"
#include "server/net/peers/address_quota.h"
#include "server/net/rooms/document.h"
#include "server/net/rooms/outbox.h"
#include "server/net/rooms/viewer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relume::net {

struct AudienceBounds {
    std::size_t viewers = 0;
    std::size_t viewers_per_address = 0;
};

// Not thread-safe; the outboxes in it are.
class Audience {
  public:
    using SharedOutbox = std::shared_ptr<Outbox>;
    using SharedSnapshot = std::shared_ptr<const wire::Snapshot>;

    enum class Refusal : std::uint8_t { full, full_for_address };

    Audience(const AudienceBounds& bounds, Metrics& metrics, Clock::time_point now);

    // `address` is the quota_key of who asks.
    [[nodiscard]] std::optional<Refusal> join(const Viewer& viewer,
                                              const SharedOutbox& outbox,
                                              const std::string& address);
    void leave(ViewerId viewer, Clock::time_point now);
    // Null for one who is not here.
    [[nodiscard]] SharedOutbox outbox_of(ViewerId viewer) const;

    [[nodiscard]] bool empty() const { return seats_.empty(); }
    [[nodiscard]] std::uint32_t size() const;
    // Since when; nothing while somebody is here.
    [[nodiscard]] std::optional<Clock::time_point> empty_since() const { return empty_since_; }

    // Whether an image of an unsettled state would be sent to anybody without waiting.
    [[nodiscard]] bool wants_moving_image() const;
    // The forms in which these viewers ask for such an image.
    [[nodiscard]] ImageForms moving_forms() const;

    // Tells every viewer of the change, and its author the id of the edit. A viewer who reads
    // too slowly for one more change gets a snapshot that holds it; `snapshot` makes it only
    // then.
    void tell_change(const DocumentChange& change,
                     const std::function<SharedSnapshot()>& snapshot);
    void tell_size();
    void tell_problem(const wire::ErrorMessage& problem);
    // Gives every viewer the frame in the form that this viewer asks for.
    void show(const ImageFrames& frames);
    // Ends every connection once its outbox is empty.
    void close_all(wire::CloseCode code);

  private:
    struct Seat {
        Viewer viewer;
        SharedOutbox outbox;
        AddressQuota::Place place;
    };

    const std::size_t most_;
    Metrics& metrics_;
    AddressQuota by_address_;
    std::vector<Seat> seats_;  // in the order of coming
    std::optional<Clock::time_point> empty_since_;
};

}  // namespace relume::net
