// The text frames between a server and the clients of a room, in both directions.
#pragma once

#include "protocol/wire/errors.h"
#include "protocol/wire/limits.h"
#include "protocol/wire/room_state.h"
#include "protocol/wire/scene_summary.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace relume::wire {

inline constexpr std::uint32_t kProtocolVersion = 1;

// Client to server.
struct Edit {
    std::uint64_t id = 0;
    nlohmann::json patch;
};
struct Ack {
    std::uint64_t sequence = 0;
};
// How the sender sees its JPEGs; what it does not choose is the room's.
struct DisplayChoice {
    std::optional<double> exposure_stops;
    std::optional<Tone> tone;

    friend bool operator==(const DisplayChoice&, const DisplayChoice&) = default;
};
using ClientMessage = std::variant<Edit, Ack, DisplayChoice>;
[[nodiscard]] Display display_from_choice(const DisplayChoice& choice, const Display& room);

// Server to client.
struct Snapshot {
    std::string room;
    SceneSummary scene;
    std::uint64_t revision = 0;
    RoomState state;
    std::uint32_t viewers = 0;
    Limits limits;
};
struct Change {
    std::uint64_t revision = 0;
    nlohmann::json patch;
    std::optional<std::uint64_t> edit_id;  // only to the edit's author
};
struct ErrorMessage {
    ErrorCode code = ErrorCode::internal;
    std::string message;
    std::string path;
    std::string found;
    std::string expected;
    std::optional<std::uint64_t> edit_id;
};
struct Viewers {
    std::uint32_t count = 0;
};
using ServerMessage = std::variant<Snapshot, Change, ErrorMessage, Viewers>;

// The server's side. Throws WireError; when the edit's id could be read, the error carries it.
// The patch is only required to be an object: apply_patch checks what is in it.
[[nodiscard]] ClientMessage parse_client_message(std::string_view text, const Limits& limits);
[[nodiscard]] std::string text_from_message(const Snapshot& message);
[[nodiscard]] std::string text_from_message(const Change& message);
[[nodiscard]] std::string text_from_message(const ErrorMessage& message);
[[nodiscard]] std::string text_from_message(const Viewers& message);
[[nodiscard]] ErrorMessage message_from_error(const WireError& error);
// The body of a failed HTTP request: {"error":{"code","message","found","expected"}}.
[[nodiscard]] std::string http_body_from_error(const WireError& error);

// The client's side. Fields this version does not know are ignored, so that a server may say
// more; a type it does not know is WireError{unknown_type}, which a client skips. A snapshot
// of another protocol version is WireError{unsupported}.
[[nodiscard]] ServerMessage parse_server_message(std::string_view text);
[[nodiscard]] std::string text_from_message(const Edit& message);
[[nodiscard]] std::string text_from_message(const Ack& message);
[[nodiscard]] std::string text_from_message(const DisplayChoice& message);

}  // namespace relume::wire
