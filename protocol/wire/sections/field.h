// One field of a section of the room's state, described once: how it is read out of the struct
// that holds it and put there, what JSON it takes, and what it means.
//
// Descriptions are constants. field_json.h reads and writes JSON by them; ../describe writes
// the contract's table and the page's types from them.
#pragma once

#include "protocol/base/text/name_table.h"
#include "protocol/wire/range.h"

#include <Imath/ImathQuat.h>
#include <Imath/ImathVec.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace relume::wire {

enum class FieldKind : std::uint8_t {
    number,
    integer,
    flag,
    triple,      // three numbers, each in the range
    direction,   // three numbers, not all zero; normalised
    quaternion,  // w, x, y, z, not all zero; normalised
    name,        // as names.h allows
    label,       // as names.h allows
    word,        // one of some
    table        // rows of as many numbers each, in the range
};

// When a state has the field.
enum class Presence : std::uint8_t {
    always,
    optional,  // null takes it away, and a state without it has no such key
    one_of  // exactly one of the section's fields marked so; setting one takes the others away
};

// The shape of a table.
struct TableRule {
    std::uint32_t least_rows = 0;
    std::uint32_t most_rows = 0;
    std::uint32_t columns = 0;
};

// Row by row.
struct NumberTable {
    std::uint32_t columns = 0;
    std::vector<double> numbers;

    [[nodiscard]] std::size_t rows() const { return numbers.size() / columns; }

    friend bool operator==(const NumberTable&, const NumberTable&) = default;
};

struct FieldRule {
    std::string_view key;
    FieldKind kind;
    std::string_view meaning;  // a line for people, with no full stop at its end
    Range range{};             // of number, integer, triple and table
    std::span<const std::string_view> words{};
    Presence presence = Presence::always;
    bool is_needed = false;  // a new entry of a keyed section has to state it
    TableRule table{};
};

// Nothing, or the one alternative that the field's kind says: double, uint32, bool, V3d (triple
// and direction), Quatd, string (name, label, word), NumberTable.
using FieldValue = std::variant<std::monostate,
                                bool,
                                double,
                                std::uint32_t,
                                Imath::V3d,
                                Imath::Quatd,
                                std::string,
                                NumberTable>;

template <typename Owner>
struct Field {
    FieldRule rule;
    FieldValue (*get)(const Owner&);
    // Takes what `rule` allows.
    void (*set)(Owner&, const FieldValue&);

    [[nodiscard]] constexpr Field needed() const {
        Field field = *this;
        field.rule.is_needed = true;
        return field;
    }
    [[nodiscard]] constexpr Field one_of() const {
        Field field = *this;
        field.rule.presence = Presence::one_of;
        return field;
    }
};

// Makers of fields: number<&Environment::gain>("gain", kGain, "…").
namespace field {

template <typename Member>
struct MemberOf;
template <typename Owner_, typename Type_>
struct MemberOf<Type_ Owner_::*> {
    using Owner = Owner_;
    using Type = Type_;
};
template <auto kMember>
using OwnerOf = typename MemberOf<decltype(kMember)>::Owner;
template <auto kMember>
using TypeOf = typename MemberOf<decltype(kMember)>::Type;

template <typename Type>
inline constexpr bool kIsOptional = false;
template <typename Type>
inline constexpr bool kIsOptional<std::optional<Type>> = true;

template <auto kMember>
constexpr Field<OwnerOf<kMember>> of(FieldRule rule) {
    using Owner = OwnerOf<kMember>;
    using Type = TypeOf<kMember>;
    if constexpr (kIsOptional<Type>) {
        rule.presence = Presence::optional;
        return {rule,
                [](const Owner& owner) {
                    const Type& value = owner.*kMember;
                    return value ? FieldValue(*value) : FieldValue();
                },
                [](Owner& owner, const FieldValue& value) {
                    if (std::holds_alternative<std::monostate>(value)) {
                        (owner.*kMember).reset();
                    } else {
                        owner.*kMember = std::get<typename Type::value_type>(value);
                    }
                }};
    } else {
        return {rule, [](const Owner& owner) { return FieldValue(owner.*kMember); },
                [](Owner& owner, const FieldValue& value) {
                    owner.*kMember = std::get<Type>(value);
                }};
    }
}

template <auto kMember>
constexpr auto number(std::string_view key, Range range, std::string_view meaning) {
    return of<kMember>({key, FieldKind::number, meaning, range});
}
template <auto kMember>
constexpr auto integer(std::string_view key, Range range, std::string_view meaning) {
    return of<kMember>({key, FieldKind::integer, meaning, range});
}
template <auto kMember>
constexpr auto flag(std::string_view key, std::string_view meaning) {
    return of<kMember>({key, FieldKind::flag, meaning});
}
template <auto kMember>
constexpr auto triple(std::string_view key, Range range, std::string_view meaning) {
    return of<kMember>({key, FieldKind::triple, meaning, range});
}
template <auto kMember>
constexpr auto direction(std::string_view key, std::string_view meaning) {
    return of<kMember>({key, FieldKind::direction, meaning});
}
template <auto kMember>
constexpr auto quaternion(std::string_view key, std::string_view meaning) {
    return of<kMember>({key, FieldKind::quaternion, meaning});
}
template <auto kMember>
constexpr auto name(std::string_view key, std::string_view meaning) {
    return of<kMember>({key, FieldKind::name, meaning});
}
template <auto kMember>
constexpr auto table(std::string_view key,
                     TableRule table,
                     Range range,
                     std::string_view meaning) {
    FieldRule rule{key, FieldKind::table, meaning, range};
    rule.table = table;
    return of<kMember>(rule);
}
template <auto kMember>
constexpr auto label(std::string_view key, std::string_view meaning) {
    return of<kMember>({key, FieldKind::label, meaning});
}

template <const auto& kNames>
inline constexpr auto kWords = kNames.words();

template <auto kMember, const auto& kNames>
constexpr Field<OwnerOf<kMember>> word(std::string_view key, std::string_view meaning) {
    using Owner = OwnerOf<kMember>;
    FieldRule rule{key, FieldKind::word, meaning};
    rule.words = kWords<kNames>;
    if constexpr (kIsOptional<TypeOf<kMember>>) {
        rule.presence = Presence::optional;
        return {rule,
                [](const Owner& owner) {
                    const auto& word = owner.*kMember;
                    return word ? FieldValue(std::string(kNames.name(*word))) : FieldValue();
                },
                [](Owner& owner, const FieldValue& value) {
                    const auto* const word = std::get_if<std::string>(&value);
                    owner.*kMember = word != nullptr ? kNames.value(*word) : std::nullopt;
                }};
    } else {
        return {rule,
                [](const Owner& owner) {
                    return FieldValue(std::string(kNames.name(owner.*kMember)));
                },
                [](Owner& owner, const FieldValue& value) {
                    owner.*kMember = kNames.value(std::get<std::string>(value)).value();
                }};
    }
}

}  // namespace field

inline constexpr Range kGain{0, 1e6};
inline constexpr Range kColour{0, 1e4};

}  // namespace relume::wire
