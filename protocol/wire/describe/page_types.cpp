#include "protocol/wire/describe/page_types.h"

#include "protocol/wire/describe/section_facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

namespace relume::wire {
namespace {

constexpr std::string_view kHead =
    R"(/**
 * The state of a room as protocol/README.md §3.1 defines it. Angles are degrees.
 *
 * Written by describe_state out of protocol/wire/sections; a test compares.
 */

export type Triple = [number, number, number];
/** w, x, y, z; unit length; world direction = R · source direction. */
export type Quaternion = [number, number, number, number];

export type Json = null | boolean | number | string | Json[] | { [key: string]: Json };
export type JsonObject = { [key: string]: Json };

export interface Range {
    lowest: number;
    highest: number;
}

)";

// "area light" → "AreaLight", "exposure_stops" → "ExposureStops".
std::string pascal(std::string_view words) {
    std::string text;
    bool is_first = true;
    for (const char c : words) {
        if (c == ' ' || c == '_') {
            is_first = true;
        } else {
            const auto letter = static_cast<unsigned char>(c);
            text += is_first ? static_cast<char>(std::toupper(letter)) : c;
            is_first = false;
        }
    }
    return text;
}

std::string type_of_section(const SectionFacts& section) {
    return section.noun.empty() ? pascal(section.key) + "State" : pascal(section.noun);
}

std::string type_of_words(const SectionFacts& section, const FieldRule& rule) {
    return pascal(section.key) + pascal(rule.key);
}

std::string type_of_field(const SectionFacts& section, const FieldRule& rule) {
    switch (rule.kind) {
        case FieldKind::number:
        case FieldKind::integer:
            return "number";
        case FieldKind::flag:
            return "boolean";
        case FieldKind::triple:
        case FieldKind::direction:
            return "Triple";
        case FieldKind::quaternion:
            return "Quaternion";
        case FieldKind::name:
        case FieldKind::label:
            return "string";
        case FieldKind::word:
            return type_of_words(section, rule);
        case FieldKind::table:
            return "number[][]";
    }
    return {};
}

std::string sentence(std::string_view meaning) {
    std::string text(meaning);
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text + ".";
}

std::string word_types(const SectionFacts& section) {
    std::string text;
    for (const FieldRule& rule : section.fields) {
        if (rule.kind == FieldKind::word) {
            text += fmt::format("export type {} = \"{}\";\n", type_of_words(section, rule),
                                fmt::join(rule.words, "\" | \""));
        }
    }
    return text;
}

std::string interface_of(const SectionFacts& section) {
    std::string text = fmt::format("/** {} */\nexport interface {} {{\n",
                                   sentence(section.meaning), type_of_section(section));
    for (const FieldRule& rule : section.fields) {
        const bool may_lack = rule.presence != Presence::always;
        text += fmt::format("    /** {} */\n    {}{}: {}{};\n", sentence(rule.meaning),
                            rule.key, may_lack ? "?" : "", type_of_field(section, rule),
                            may_lack ? " | null" : "");
    }
    return text + "}\n\n";
}

std::string room_state(const std::vector<SectionFacts>& sections) {
    std::string text = "export interface RoomState {\n";
    for (const SectionFacts& section : sections) {
        const std::string type = type_of_section(section);
        text += fmt::format(
            "    {}: {};\n", section.key,
            section.noun.empty() ? type : fmt::format("{{ [id: string]: {} }}", type));
    }
    return text + "}\n\n";
}

std::string stages(const std::vector<SectionFacts>& sections) {
    std::string text = "/** What an edit makes a server do again. */\nexport type Stage =";
    for (const Stage stage : {Stage::signal, Stage::view, Stage::display, Stage::policy}) {
        text += fmt::format("{} \"{}\"", stage == Stage::signal ? "" : " |", name_from(stage));
    }
    text += ";\n\nexport const kStages: { readonly [section in keyof RoomState]: Stage } = {\n";
    for (const SectionFacts& section : sections) {
        text += fmt::format("    {}: \"{}\",\n", section.key, name_from(section.stage));
    }
    return text + "};\n\n";
}

std::string ranges(const std::vector<SectionFacts>& sections) {
    std::string text =
        "/** Of numbers, and of each number of a triple. */\n"
        "export const kRanges = {\n";
    for (const SectionFacts& section : sections) {
        std::string fields;
        for (const FieldRule& rule : section.fields) {
            if (rule.range.highest > rule.range.lowest) {
                fields += fmt::format("        {}: {{ lowest: {}, highest: {} }},\n", rule.key,
                                      text_from_number(rule.range.lowest),
                                      text_from_number(rule.range.highest));
            }
        }
        if (!fields.empty()) {
            text += fmt::format("    {}: {{\n{}    }},\n", section.key, fields);
        }
    }
    return text + "} as const satisfies { [section: string]: { [field: string]: Range } };\n";
}

std::string absent_fields(const std::vector<SectionFacts>& sections) {
    std::string text =
        "/** Fields that a state may lack; null in a patch takes them away. */\n"
        "export const kAbsent: { readonly [section in keyof RoomState]?: readonly string[] } = "
        "{\n";
    for (const SectionFacts& section : sections) {
        std::vector<std::string_view> keys;
        for (const FieldRule& rule : section.fields) {
            if (rule.presence != Presence::always) {
                keys.push_back(rule.key);
            }
        }
        if (!keys.empty()) {
            text += fmt::format("    {}: [\"{}\"],\n", section.key, fmt::join(keys, "\", \""));
        }
    }
    return text + "};\n\n";
}

}  // namespace

std::string page_types() {
    const std::vector<SectionFacts> sections = section_facts();
    std::string text(kHead);
    for (const SectionFacts& section : sections) {
        text += word_types(section);
    }
    text += "\n";
    for (const SectionFacts& section : sections) {
        text += interface_of(section);
    }
    return text + room_state(sections) + stages(sections) + absent_fields(sections) +
           ranges(sections);
}

}  // namespace relume::wire
