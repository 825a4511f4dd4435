// All rooms of a server, by name.
#pragma once

#include "protocol/wire/errors.h"
#include "server/net/peers/address_quota.h"
#include "server/net/peers/role.h"
#include "server/net/rooms/room.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace relume::net {

struct RoomsOptions {
    RoomOptions room;
    // How long a room is kept after its last viewer has left.
    std::chrono::milliseconds linger{std::chrono::minutes(5)};
    // What a new room's state begins with.
    std::string environment = "sky-afternoon";
    // Of all rooms, those that clients of one address have made.
    std::size_t rooms_per_address = 32;
};

// Thread-safe. As a work item it drops rooms that have been empty for long.
class Rooms : public WorkItem, public std::enable_shared_from_this<Rooms> {
  public:
    // Throws std::runtime_error if the library has no environment of that name.
    Rooms(const SceneLibrary& scenes,
          const Libraries& libraries,
          RoomThreads threads,
          Metrics& metrics,
          RoomsOptions options);

    // Who asks to come in.
    struct Visitor {
        Role role = Role::none;
        Audience::SharedOutbox outbox;
        // The quota_key. A room that is made for this visitor counts as this address's until
        // the room is dropped.
        std::string address;
    };
    struct Entered {
        std::shared_ptr<Room> room;
        ViewerId viewer;
    };
    struct Refusal {
        wire::CloseCode code;
        std::string expected;  // more than the code says; may be empty
    };
    // Joins the room, making it if there is none, or if it is empty and its scene has been
    // replaced. Refuses with bad_token, unknown_scene, room_full, too_many_rooms or
    // shutting_down.
    [[nodiscard]] std::variant<Entered, Refusal> enter(const std::string& name,
                                                       const std::optional<std::string>& scene,
                                                       const Visitor& visitor);
    void leave(Room& room, ViewerId viewer);

    // Has to be called when scenes have been added, replaced or removed. A room keeps the scene
    // that it began with as long as anybody is in it; an empty room of another scene is
    // dropped.
    void drop_outdated();

    // As Room::environment_replaced, for all.
    void environment_replaced(const std::string& name);

    // No new rooms or clients, no more edits.
    void stop_edits();
    [[nodiscard]] bool has_pending_edit() const;
    void close_all(wire::CloseCode code);

    void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept override;

  private:
    // The room of that name, which is made where there is none.
    [[nodiscard]] std::variant<std::shared_ptr<Room>, Refusal> room_locked(
        const std::string& name,
        const std::optional<std::string>& scene,
        const std::string& address);
    struct Entry {
        std::shared_ptr<Room> room;
        std::string creator;
        AddressQuota::Place place;
    };
    // Drops the longest empty room of one creator, or of all; false where none is empty.
    [[nodiscard]] bool drop_longest_empty_locked(const std::optional<std::string>& creator);
    // Null when there is none left, even after dropping an empty one.
    [[nodiscard]] AddressQuota::Place place_for_room_locked(const std::string& creator);
    // Its scene is no longer what is offered under that name.
    [[nodiscard]] bool is_outdated(const Room& room) const;

    const SceneLibrary& scenes_;
    const Libraries libraries_;
    const RoomThreads threads_;
    Metrics& metrics_;
    const RoomsOptions options_;
    // What a new room begins with, even where the library does not offer it any more.
    const std::shared_ptr<Environment> first_environment_;

    mutable std::mutex mutex_;
    std::map<std::string, Entry, std::less<>> rooms_;
    AddressQuota by_address_;
    std::uint64_t last_viewer_ = 0;
    bool stopped_ = false;
};

}  // namespace relume::net
