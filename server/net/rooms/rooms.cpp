#include "server/net/rooms/rooms.h"

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
             const Libraries& libraries,
             RoomThreads threads,
             Metrics& metrics,
             RoomsOptions options)
    : scenes_(scenes),
      libraries_(libraries),
      threads_(threads),
      metrics_(metrics),
      options_(std::move(options)),
      first_environment_(require_environment(libraries.environments, options_.environment)),
      by_address_(options_.rooms_per_address) {}

std::variant<Rooms::Entered, Rooms::Refusal> Rooms::enter(
    const std::string& name, const std::optional<std::string>& scene, const Visitor& visitor) {
    if (visitor.role == Role::none) {
        return Refusal{.code = wire::CloseCode::bad_token, .expected = {}};
    }
    const std::lock_guard lock(mutex_);
    if (stopped_) {
        return Refusal{.code = wire::CloseCode::shutting_down, .expected = {}};
    }
    auto room = room_locked(name, scene, visitor.address);
    if (const Refusal* const refusal = std::get_if<Refusal>(&room)) {
        return *refusal;
    }
    Entered entered{.room = std::get<std::shared_ptr<Room>>(std::move(room)),
                    .viewer = ViewerId{++last_viewer_}};
    const auto full = entered.room->join({.id = entered.viewer, .role = visitor.role},
                                         visitor.outbox, visitor.address);
    if (full) {
        const RoomOptions& bounds = options_.room;
        return Refusal{
            .code = wire::CloseCode::room_full,
            .expected =
                full == Audience::Refusal::full
                    ? fmt::format("at most {}", bounds.limits.clients_per_room)
                    : fmt::format("at most {} from one address", bounds.clients_per_address)};
    }
    return entered;
}

std::variant<std::shared_ptr<Room>, Rooms::Refusal> Rooms::room_locked(
    const std::string& name,
    const std::optional<std::string>& scene,
    const std::string& address) {
    const Refusal unknown_scene{.code = wire::CloseCode::unknown_scene,
                                .expected = scenes_.expected_in_place_of(scene.value_or(""))};
    auto known = rooms_.find(name);
    if (known != rooms_.end() && known->second.room->empty_since() &&
        is_outdated(*known->second.room)) {
        rooms_.erase(known);
        known = rooms_.end();
    }
    if (known != rooms_.end()) {
        const std::shared_ptr<Room>& room = known->second.room;
        if (scene && *scene != room->scene().name) {
            return unknown_scene;
        }
        return room;
    }
    std::shared_ptr<const ServedScene> served = scene ? scenes_.find(*scene) : nullptr;
    if (!served) {
        return unknown_scene;
    }
    AddressQuota::Place place = place_for_room_locked(address);
    if (!place) {
        return Refusal{.code = wire::CloseCode::too_many_rooms, .expected = {}};
    }
    spdlog::info("room_opened room={} scene={}", name, served->name);
    const std::shared_ptr<Environment> first =
        libraries_.environments.find(options_.environment);
    auto room =
        std::make_shared<Room>(name, std::move(served), first ? first : first_environment_,
                               libraries_, threads_, metrics_, options_.room);
    rooms_.emplace(name, Entry{.room = room, .creator = address, .place = std::move(place)});
    metrics_.set_rooms(rooms_.size());
    return room;
}

void Rooms::leave(Room& room, ViewerId viewer) {
    room.leave(viewer);
    if (room.empty_since() && is_outdated(room)) {
        drop_outdated();
    } else if (room.empty_since()) {
        threads_.workers.enqueue_after(shared_from_this(), WorkPriority::refinement,
                                       options_.linger);
    }
}

AddressQuota::Place Rooms::place_for_room_locked(const std::string& creator) {
    AddressQuota::Place place = by_address_.take(creator);
    if (!place && drop_longest_empty_locked(creator)) {
        place = by_address_.take(creator);
    }
    const bool fits = rooms_.size() < options_.room.limits.rooms;
    return place && (fits || drop_longest_empty_locked({})) ? place : nullptr;
}

bool Rooms::drop_longest_empty_locked(const std::optional<std::string>& creator) {
    auto longest = rooms_.end();
    Clock::time_point since = Clock::time_point::max();
    for (auto it = rooms_.begin(); it != rooms_.end(); ++it) {
        const std::optional<Clock::time_point> empty = it->second.room->empty_since();
        if (empty && *empty < since &&
            creator.value_or(it->second.creator) == it->second.creator) {
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

bool Rooms::is_outdated(const Room& room) const {
    return scenes_.find(room.scene().name).get() != &room.scene();
}

void Rooms::drop_outdated() {
    const std::lock_guard lock(mutex_);
    std::erase_if(rooms_, [&](const auto& entry) {
        const Room& room = *entry.second.room;
        const bool drops = room.empty_since() && is_outdated(room);
        if (drops) {
            spdlog::info("room_dropped room={} reason=\"its scene was replaced\"", entry.first);
        }
        return drops;
    });
    metrics_.set_rooms(rooms_.size());
}

void Rooms::run(std::span<const std::shared_ptr<WorkItem>> /*others*/) noexcept {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    std::optional<Clock::time_point> next;
    std::erase_if(rooms_, [&](const auto& entry) {
        const std::optional<Clock::time_point> empty = entry.second.room->empty_since();
        if (!empty) {
            return false;
        }
        if (now - *empty >= options_.linger || is_outdated(*entry.second.room)) {
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

void Rooms::environment_replaced(const std::string& name) {
    const std::lock_guard lock(mutex_);
    for (const auto& [room_name, entry] : rooms_) {
        entry.room->environment_replaced(name);
    }
}

void Rooms::stop_edits() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    for (const auto& [name, entry] : rooms_) {
        entry.room->stop_edits();
    }
}

bool Rooms::has_pending_edit() const {
    const std::lock_guard lock(mutex_);
    return std::any_of(rooms_.begin(), rooms_.end(),
                       [](const auto& entry) { return entry.second.room->has_pending_edit(); });
}

void Rooms::close_all(wire::CloseCode code) {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, entry] : rooms_) {
        entry.room->close_all(code);
    }
}

}  // namespace relume::net
