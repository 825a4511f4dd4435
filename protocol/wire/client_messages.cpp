#include "protocol/wire/json_text.h"
#include "protocol/wire/messages.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/field_json.h"

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

// What the message states for a field of `display`; null says no more than leaving it out.
template <typename Type>
std::optional<Type> stated(ObjectReader& reader,
                           const Field<Display>& field,
                           Type Display::*member) {
    const json* const value = reader.find(field.rule.key);
    if (value == nullptr || value->is_null()) {
        return std::nullopt;
    }
    Display display;
    field.set(display, value_from_json(field.rule, *value, reader.path_to(field.rule.key)));
    return display.*member;
}

DisplayChoice display_choice_from_json(ObjectReader& reader) {
    const DisplayChoice choice{
        .exposure_stops = stated(reader, kExposureStopsField, &Display::exposure_stops),
        .tone = stated(reader, kToneField, &Display::tone)};
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
        text["tone"] = kToneNames.name(*message.tone);
    }
    return text.dump();
}

}  // namespace relume::wire
