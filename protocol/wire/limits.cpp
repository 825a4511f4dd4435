#include "protocol/wire/limits.h"

#include "protocol/wire/object_reader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string_view>
#include <utility>

namespace relume::wire {
namespace {

using Field = std::pair<std::string_view, std::uint64_t Limits::*>;

constexpr std::array<Field, 13> kFields{{
    {"message_bytes", &Limits::message_bytes},
    {"messages_per_second", &Limits::messages_per_second},
    {"message_burst", &Limits::message_burst},
    {"lights_per_room", &Limits::lights_per_room},
    {"materials_per_room", &Limits::materials_per_room},
    {"finishes_per_room", &Limits::finishes_per_room},
    {"clients_per_room", &Limits::clients_per_room},
    {"rooms", &Limits::rooms},
    {"images_in_flight", &Limits::images_in_flight},
    {"upload_bytes", &Limits::upload_bytes},
    {"uploads", &Limits::uploads},
    {"errors_per_connection", &Limits::errors_per_connection},
    {"image_pixels", &Limits::image_pixels},
}};

}  // namespace

nlohmann::json to_json(const Limits& limits) {
    auto object = nlohmann::json::object();
    for (const auto& [key, member] : kFields) {
        object[std::string(key)] = limits.*member;
    }
    return object;
}

Limits limits_from_json(const nlohmann::json& object) {
    Limits limits;
    ObjectReader reader(object, "/limits");
    for (const auto& [key, member] : kFields) {
        if (const nlohmann::json* value = reader.find(key)) {
            limits.*member = integer_from_json(*value, reader.path_to(key), 0, kMaxInteger);
        }
    }
    return limits;
}

}  // namespace relume::wire
