#include "protocol/wire/describe/contract_table.h"

#include "protocol/base/text/names.h"
#include "protocol/wire/describe/section_facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace relume::wire {
namespace {

using nlohmann::json;

std::string code(std::string_view text) {
    return fmt::format("`{}`", text);
}

std::string range_text(Range range) {
    return fmt::format("{} … {}", text_from_number(range.lowest),
                       text_from_number(range.highest));
}

std::string kind_text(const FieldRule& rule) {
    switch (rule.kind) {
        case FieldKind::number:
            return range_text(rule.range);
        case FieldKind::integer:
            return "an integer " + range_text(rule.range);
        case FieldKind::flag:
            return "true or false";
        case FieldKind::triple:
            return "three numbers " + range_text(rule.range);
        case FieldKind::direction:
            return "three numbers, not all zero; normalised by the server";
        case FieldKind::quaternion:
            return "four numbers w, x, y, z, not all zero; normalised by the server";
        case FieldKind::name:
            return "a name";
        case FieldKind::label:
            return fmt::format("a label: {}", text::kLabelRule);
        case FieldKind::word: {
            std::vector<std::string> words;
            for (const std::string_view word : rule.words) {
                words.push_back(code(word));
            }
            return fmt::format("{}", fmt::join(words, ", "));
        }
        case FieldKind::table: {
            const TableRule& table = rule.table;
            return fmt::format("an array of {} arrays of {} numbers {}",
                               table.least_rows == table.most_rows
                                   ? std::to_string(table.least_rows)
                                   : fmt::format("{} to {}", table.least_rows, table.most_rows),
                               table.columns, range_text(rule.range));
        }
    }
    return {};
}

std::string default_text(const FieldRule& rule, const json& value) {
    if (rule.is_needed) {
        return "has to be stated";
    }
    if (value.is_null()) {
        return "none";
    }
    if (value.is_number()) {
        return text_from_number(value.get<double>());
    }
    if (value.is_array()) {
        std::vector<std::string> numbers;
        for (const json& number : value) {
            numbers.push_back(text_from_number(number.get<double>()));
        }
        return fmt::format("{}", fmt::join(numbers, ", "));
    }
    return value.is_string() ? code(value.get<std::string>()) : value.dump();
}

std::string keys_text(const std::vector<FieldRule>& fields, auto&& is_meant) {
    std::vector<std::string> keys;
    for (const FieldRule& rule : fields) {
        if (is_meant(rule)) {
            keys.push_back(code(rule.key));
        }
    }
    return fmt::format("{}", fmt::join(keys, ", "));
}

std::string presence_text(const FieldRule& rule, const SectionFacts& section) {
    switch (rule.presence) {
        case Presence::always:
            return {};
        case Presence::optional:
            return "; null takes it away, and a state without it has no such key";
        case Presence::one_of:
            return fmt::format(
                "; a state has exactly one of {}, and setting one takes the "
                "other away",
                keys_text(section.fields,
                          [](const FieldRule& r) { return r.presence == Presence::one_of; }));
    }
    return {};
}

std::string section_row(const SectionFacts& section) {
    std::string takes;
    if (!section.noun.empty()) {
        takes = fmt::format(
            " by ID, as ROOM and NAME; null removes one, and does nothing where there is none; "
            "a "
            "new one states {}",
            keys_text(section.fields, [](const FieldRule& rule) { return rule.is_needed; }));
    } else if (!section.spelled.empty()) {
        const auto all = [](const FieldRule&) { return true; };
        takes = fmt::format(" either {} or some of {}", keys_text(section.fields, all),
                            keys_text(section.spelled, all));
    }
    return fmt::format("| **{}** |{} | | {}; *{}* |\n", code(section.key), takes,
                       section.meaning, name_from(section.stage));
}

std::string field_row(const FieldRule& rule, const SectionFacts& section) {
    const std::string path =
        fmt::format("{}.{}{}", section.key, section.noun.empty() ? "" : "*.", rule.key);
    return fmt::format(
        "| {} | {}{} | {} | {} |\n", code(path), kind_text(rule), presence_text(rule, section),
        default_text(rule, section.defaults.value(std::string(rule.key), json(0))),
        rule.meaning);
}

}  // namespace

std::string contract_table() {
    std::string table = "| path | takes | default | meaning |\n|---|---|---|---|\n";
    for (const SectionFacts& section : section_facts()) {
        table += section_row(section);
        for (const FieldRule& rule : section.fields) {
            table += field_row(rule, section);
        }
        for (const FieldRule& rule : section.spelled) {
            table += field_row(rule, section);
        }
    }
    return table;
}

}  // namespace relume::wire
