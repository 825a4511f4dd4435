// A section of the room's state, described once: its key, the stage that an edit of it touches,
// and its fields.
#pragma once

#include "protocol/wire/limits.h"
#include "protocol/wire/sections/field.h"
#include "protocol/wire/stages.h"

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace relume::wire {

// Numbers that a patch may state in place of a section's fields, such as three angles in place
// of a quaternion. A number that is not given is 0.
template <typename Owner>
struct Spelling {
    std::span<const FieldRule> fields;
    Owner (*meaning)(std::span<const double> numbers) = nullptr;
};

// An object of the state's JSON, which the struct `Owner` holds. A default-constructed Owner is
// its default.
template <typename Owner>
struct Section {
    std::string_view key;
    Stage stage;
    std::string_view meaning;  // a line for people, with no full stop at its end
    std::span<const Field<Owner>> fields;
    Spelling<Owner> spelling{};
};

// An object of entries by id. In a patch a null takes an entry away, and an id that is not
// there makes a new one.
template <typename Entry>
struct KeyedSection {
    Section<Entry> entry;    // its key and stage are the section's
    std::string_view noun;   // of an entry, singular, as it stands in sentences
    std::string_view nouns;  // plural, for errors
    Entry (*fresh)(const std::map<std::string, Entry>& others);
    std::uint64_t Limits::*most;  // entries at a time
};

}  // namespace relume::wire
