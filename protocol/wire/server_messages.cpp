#include "protocol/wire/json_text.h"
#include "protocol/wire/known_part.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/object_reader.h"

#include <nlohmann/json.hpp>

#include <limits>

namespace relume::wire {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxCount = std::numeric_limits<std::uint32_t>::max();

// A message may quote a file name that is not UTF-8; a reader must still get JSON.
std::string text_from_json(const json& message) {
    return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::uint32_t count_from(ObjectReader& reader, const char* key) {
    return static_cast<std::uint32_t>(
        integer_from_json(reader.require(key), reader.path_to(key), 0, kMaxCount));
}

std::uint64_t integer_from(ObjectReader& reader, const char* key) {
    return integer_from_json(reader.require(key), reader.path_to(key), 0, kMaxInteger);
}

std::string text_from(ObjectReader& reader, const char* key) {
    const json* value = reader.find(key);
    return value == nullptr ? std::string() : string_from_json(*value, reader.path_to(key));
}

std::optional<std::uint64_t> edit_id_from(ObjectReader& reader) {
    const json* value = reader.find("edit_id");
    if (value == nullptr || value->is_null()) {
        return std::nullopt;
    }
    return integer_from_json(*value, "/edit_id", 0, kMaxInteger);
}

Snapshot snapshot_from(ObjectReader& reader) {
    if (const std::uint64_t version = integer_from(reader, "protocol");
        version != kProtocolVersion) {
        throw WireError(ErrorCode::unsupported, "/protocol", std::to_string(version),
                        std::to_string(kProtocolVersion));
    }
    SceneSummary scene = scene_summary_from_json(reader.require("scene"), "/scene");
    const json& stated = reader.require("state");
    RoomState state = room_state_from_json(known_part(stated));
    if (!stated.contains("image")) {
        // An older server: its images are as large as the scene.
        state.image = {.width = scene.width, .height = scene.height};
    }
    return {.room = name_from_json(reader.require("room"), "/room"),
            .scene = std::move(scene),
            .revision = integer_from(reader, "revision"),
            .state = std::move(state),
            .viewers = count_from(reader, "viewers"),
            .limits = limits_from_json(reader.require("limits"))};
}

Change change_from(ObjectReader& reader) {
    const json& patch = reader.require("patch");
    if (!patch.is_object()) {
        throw WireError(ErrorCode::wrong_type, "/patch", quote(patch), "an object");
    }
    return {.revision = integer_from(reader, "revision"),
            .patch = known_part(patch),
            .edit_id = edit_id_from(reader)};
}

ErrorMessage error_from(ObjectReader& reader) {
    // A code this version does not know is still an error to report.
    const auto code = error_code_from_name(string_from_json(reader.require("code"), "/code"));
    return {.code = code.value_or(ErrorCode::internal),
            .message = text_from(reader, "message"),
            .path = text_from(reader, "path"),
            .found = text_from(reader, "found"),
            .expected = text_from(reader, "expected"),
            .edit_id = edit_id_from(reader)};
}

}  // namespace

std::string text_from_message(const Snapshot& message) {
    return text_from_json({{"type", "snapshot"},
                           {"protocol", kProtocolVersion},
                           {"room", message.room},
                           {"scene", to_json(message.scene)},
                           {"revision", message.revision},
                           {"state", to_json(message.state)},
                           {"viewers", message.viewers},
                           {"limits", to_json(message.limits)}});
}

std::string text_from_message(const Change& message) {
    json object = {
        {"type", "change"}, {"revision", message.revision}, {"patch", message.patch}};
    if (message.edit_id) {
        object["edit_id"] = *message.edit_id;
    }
    return text_from_json(object);
}

std::string text_from_message(const ErrorMessage& message) {
    json object = {{"type", "error"},
                   {"code", name_from_error_code(message.code)},
                   {"message", message.message},
                   {"path", message.path},
                   {"found", message.found},
                   {"expected", message.expected}};
    if (message.edit_id) {
        object["edit_id"] = *message.edit_id;
    }
    return text_from_json(object);
}

std::string text_from_message(const Viewers& message) {
    return text_from_json({{"type", "viewers"}, {"count", message.count}});
}

ErrorMessage message_from_error(const WireError& error) {
    return {.code = error.code(),
            .message = error.what(),
            .path = error.path(),
            .found = error.found(),
            .expected = error.expected(),
            .edit_id = error.edit_id()};
}

std::string http_body_from_error(const WireError& error) {
    return text_from_json({{"error",
                            {{"code", name_from_error_code(error.code())},
                             {"message", error.what()},
                             {"found", error.found()},
                             {"expected", error.expected()}}}});
}

ServerMessage parse_server_message(std::string_view text) {
    const json message = parse_json(text, kMaxServerMessageBytes);
    ObjectReader reader(message, "");
    const std::string type = string_from_json(reader.require("type"), "/type");
    if (type == "snapshot") {
        return snapshot_from(reader);
    }
    if (type == "change") {
        return change_from(reader);
    }
    if (type == "error") {
        return error_from(reader);
    }
    if (type == "viewers") {
        return Viewers{.count = count_from(reader, "count")};
    }
    throw WireError(ErrorCode::unknown_type, "/type", quote(json(type)),
                    "one of snapshot, change, error, viewers");
}

}  // namespace relume::wire
