#include "protocol/wire/known_part.h"

#include "protocol/wire/sections/room_sections.h"

#include <nlohmann/json.hpp>

namespace relume::wire {
namespace {

using nlohmann::json;

template <typename Owner>
json known_part(const Section<Owner>& section, const json& object) {
    if (!object.is_object()) {
        return object;
    }
    json known = json::object();
    const auto keep = [&](const FieldRule& rule) {
        if (const auto value = object.find(rule.key); value != object.end()) {
            known[std::string(rule.key)] = *value;
        }
    };
    for (const Field<Owner>& field : section.fields) {
        keep(field.rule);
    }
    for (const FieldRule& rule : section.spelling.fields) {
        keep(rule);
    }
    return known;
}

template <typename Entry>
json known_part(const KeyedSection<Entry>& section, const json& object) {
    if (!object.is_object()) {
        return object;
    }
    json known = json::object();
    for (const auto& [id, entry] : object.items()) {
        known[id] = known_part(section.entry, entry);
    }
    return known;
}

}  // namespace

json known_part(const json& state) {
    if (!state.is_object()) {
        return state;
    }
    json known = json::object();
    for_each_section([&](const auto& section, auto) {
        const std::string key(fields_of(section).key);
        if (const auto value = state.find(key); value != state.end()) {
            known[key] = known_part(section, *value);
        }
    });
    return known;
}

}  // namespace relume::wire
