#include "protocol/wire/json_text.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/patch_section.h"
#include "protocol/wire/room_names.h"

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

DisplayChoice display_choice_from_json(ObjectReader& reader) {
    DisplayChoice choice;
    const json* const stops = reader.find("exposure_stops");
    if (stops != nullptr && !stops->is_null()) {
        choice.exposure_stops = number_from_json(*stops, "/exposure_stops", kExposureStops);
    }
    const json* const tone = reader.find("tone");
    if (tone != nullptr && !tone->is_null()) {
        choice.tone = kToneNames.value(string_from_json(*tone, "/tone"));
        if (!choice.tone) {
            throw WireError(ErrorCode::out_of_range, "/tone", quote(*tone),
                            kToneNames.alternatives());
        }
    }
    reader.refuse_other_keys();
    return choice;
}

}  // namespace

Display display_from_choice(const DisplayChoice& choice, const Display& room) {
    return {.exposure_stops = choice.exposure_stops.value_or(room.exposure_stops),
            .tone = choice.tone.value_or(room.tone)};
}

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
    if (type == "display") {
        return display_choice_from_json(reader);
    }
    throw WireError(ErrorCode::unknown_type, "/type", quote(json(type)),
                    "one of edit, ack, display");
}

std::string text_from_message(const Edit& message) {
    return json{{"type", "edit"}, {"id", message.id}, {"patch", message.patch}}.dump();
}

std::string text_from_message(const Ack& message) {
    return json{{"type", "ack"}, {"sequence", message.sequence}}.dump();
}

std::string text_from_message(const DisplayChoice& message) {
    json text{{"type", "display"}, {"exposure_stops", nullptr}, {"tone", nullptr}};
    if (message.exposure_stops) {
        text["exposure_stops"] = *message.exposure_stops;
    }
    if (message.tone) {
        text["tone"] = name_from(*message.tone);
    }
    return text.dump();
}

}  // namespace relume::wire
