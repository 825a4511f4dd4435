// All rooms of a server, by name.
#pragma once

#include "protocol/wire/errors.h"
#include "server/net/room.h"

#include <chrono>
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
    // A room that everybody left is kept so long.
    std::chrono::milliseconds linger{std::chrono::minutes(5)};
    // What a new room's state begins with.
    std::string environment = "sky-afternoon";
};

// Thread-safe. As a work item it drops rooms that have been empty for long.
class Rooms : public WorkItem, public std::enable_shared_from_this<Rooms> {
  public:
    // Throws std::runtime_error if the library has no environment of that name.
    Rooms(const SceneLibrary& scenes,
          const EnvironmentLibrary& environments,
          RoomThreads threads,
          Metrics& metrics,
          RoomsOptions options);

    // Joins the room, making it if there is none. Otherwise the reason to close with:
    // unknown_scene, room_full, too_many_rooms, shutting_down.
    [[nodiscard]] std::variant<std::shared_ptr<Room>, wire::CloseCode> enter(
        const std::string& name,
        const std::optional<std::string>& scene,
        const Room::SharedOutbox& viewer);
    void leave(Room& room, const Room::SharedOutbox& viewer);

    // No new rooms or clients, no more edits.
    void stop_edits();
    [[nodiscard]] bool has_pending_edit() const;
    void close_all(wire::CloseCode code);

    void run(std::span<const std::shared_ptr<WorkItem>> others) noexcept override;

  private:
    [[nodiscard]] std::shared_ptr<Room> make_room_locked(
        const std::string& name, std::shared_ptr<const ServedScene> scene);
    [[nodiscard]] bool drop_longest_empty_locked();

    const SceneLibrary& scenes_;
    const EnvironmentLibrary& environments_;
    const RoomThreads threads_;
    Metrics& metrics_;
    const RoomsOptions options_;
    const std::shared_ptr<Environment> first_environment_;

    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Room>, std::less<>> rooms_;
    bool stopped_ = false;
};

}  // namespace relume::net
