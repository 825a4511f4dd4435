#include "protocol/wire/json_text.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/object_reader.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

using nlohmann::json;

Edit edit_from_json(ObjectReader& reader, json& message) {
    const std::uint64_t id = integer_from_json(reader.require("id"), "/id", 0, kMaxInteger);
    try {
        const json& patch = reader.require("patch");
        if (!patch.is_object()) {
            throw WireError(ErrorCode::wrong_type, "/patch", quote(patch), "an object");
        }
        reader.refuse_other_keys();
    } catch (const WireError& error) {
        throw error.with_edit_id(id);
    }
    return {.id = id, .patch = std::move(message["patch"])};
}

}  // namespace

ClientMessage parse_client_message(std::string_view text, const Limits& limits) {
    json message = parse_json(text, limits.message_bytes);
    ObjectReader reader(message, "");
    const std::string type = string_from_json(reader.require("type"), "/type");
    if (type == "edit") {
        return edit_from_json(reader, message);
    }
    if (type == "ack") {
        const Ack ack{.sequence = integer_from_json(reader.require("sequence"), "/sequence", 0,
                                                    kMaxInteger)};
        reader.refuse_other_keys();
        return ack;
    }
    throw WireError(ErrorCode::unknown_type, "/type", quote(json(type)), "one of edit, ack");
}

std::string text_from_message(const Edit& message) {
    return json{{"type", "edit"}, {"id", message.id}, {"patch", message.patch}}.dump();
}

std::string text_from_message(const Ack& message) {
    return json{{"type", "ack"}, {"sequence", message.sequence}}.dump();
}

}  // namespace relume::wire
