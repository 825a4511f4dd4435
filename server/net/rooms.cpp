#include "server/net/rooms.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace relume::net {

namespace {

std::shared_ptr<Environment> require_environment(const EnvironmentLibrary& library,
                                                 const std::string& name) {
    std::shared_ptr<Environment> environment = library.find(name);
    if (!environment) {
        throw std::runtime_error(
            fmt::format("there is no environment {} to begin a room with", name));
    }
    return environment;
}

}  // namespace

Rooms::Rooms(const SceneLibrary& scenes,
             const EnvironmentLibrary& environments,
             RoomThreads threads,
             Metrics& metrics,
             RoomsOptions options)
    : scenes_(scenes),
      environments_(environments),
      threads_(threads),
      metrics_(metrics),
      options_(std::move(options)),
      first_environment_(require_environment(environments, options_.environment)) {}

std::variant<std::shared_ptr<Room>, wire::CloseCode> Rooms::enter(
    const std::string& name,
    const std::optional<std::string>& scene,
    const Room::SharedOutbox& viewer) {
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        return wire::CloseCode::shutting_down;
    }
    const auto known = rooms_.find(name);
    if (known != rooms_.end()) {
        const std::shared_ptr<Room>& room = known->second;
        if (scene && *scene != room->scene().name) {
            return wire::CloseCode::unknown_scene;
        }
        if (!room->join(viewer)) {
            return wire::CloseCode::room_full;
        }
        return room;
    }
    std::shared_ptr<const ServedScene> served = scene ? scenes_.find(*scene) : nullptr;
    if (!served) {
        return wire::CloseCode::unknown_scene;
    }
    if (rooms_.size() >= options_.room.limits.rooms && !drop_longest_empty_locked()) {
        return wire::CloseCode::too_many_rooms;
    }
    std::shared_ptr<Room> room = make_room_locked(name, std::move(served));
    if (!room->join(viewer)) {
        return wire::CloseCode::room_full;
    }
    return room;
}

std::shared_ptr<Room> Rooms::make_room_locked(const std::string& name,
                                              std::shared_ptr<const ServedScene> scene) {
    spdlog::info("room_opened room={} scene={}", name, scene->name);
    auto room = std::make_shared<Room>(name, std::move(scene), first_environment_,
                                       environments_, threads_, metrics_, options_.room);
    rooms_.emplace(name, room);
    metrics_.set_rooms(rooms_.size());
    return room;
}

void Rooms::leave(Room& room, const Room::SharedOutbox& viewer) {
    room.leave(viewer);
    if (room.empty_since()) {
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       options_.linger);
    }
}

bool Rooms::drop_longest_empty_locked() {
    auto longest = rooms_.end();
    Clock::time_point since = Clock::time_point::max();
    for (auto it = rooms_.begin(); it != rooms_.end(); ++it) {
        const std::optional<Clock::time_point> empty = it->second->empty_since();
        if (empty && *empty < since) {
            since = *empty;
            longest = it;
        }
    }
    if (longest == rooms_.end()) {
        return false;
    }
    spdlog::info("room_dropped room={} reason=\"room for another\"", longest->first);
    rooms_.erase(longest);
    return true;
}

void Rooms::run(std::span<const std::shared_ptr<WorkItem>> /*others*/) noexcept {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    std::optional<Clock::time_point> next;
    std::erase_if(rooms_, [&](const auto& entry) {
        const std::optional<Clock::time_point> empty = entry.second->empty_since();
        if (!empty) {
            return false;
        }
        if (now - *empty >= options_.linger) {
            spdlog::info("room_dropped room={} reason=empty", entry.first);
            return true;
        }
        next = std::min(next.value_or(*empty), *empty);
        return false;
    });
    metrics_.set_rooms(rooms_.size());
    if (next) {
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       *next + options_.linger - now);
    }
}

void Rooms::stop_edits() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    for (const auto& [name, room] : rooms_) {
        room->stop_edits();
    }
}

bool Rooms::has_pending_edit() const {
    const std::lock_guard lock(mutex_);
    return std::any_of(rooms_.begin(), rooms_.end(),
                       [](const auto& entry) { return entry.second->has_pending_edit(); });
}

void Rooms::close_all(wire::CloseCode code) {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, room] : rooms_) {
        room->close_all(code);
    }
}

}  // namespace relume::net
