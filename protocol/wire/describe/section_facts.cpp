#include "protocol/wire/describe/section_facts.h"

#include "protocol/wire/sections/room_sections.h"
#include "protocol/wire/sections/section_json.h"

#include <fmt/format.h>

#include <cmath>

namespace relume::wire {
namespace {

template <typename Owner>
SectionFacts facts_of(const Section<Owner>& section) {
    SectionFacts facts{
        .key = section.key,
        .stage = section.stage,
        .meaning = section.meaning,
        .noun = {},
        .fields = {},
        .spelled = {section.spelling.fields.begin(), section.spelling.fields.end()},
        .defaults = to_json(section, Owner{}, Absent::null)};
    for (const Field<Owner>& field : section.fields) {
        facts.fields.push_back(field.rule);
    }
    return facts;
}

template <typename Entry>
SectionFacts facts_of(const KeyedSection<Entry>& section) {
    SectionFacts facts = facts_of(section.entry);
    facts.noun = section.noun;
    return facts;
}

}  // namespace

std::vector<SectionFacts> section_facts() {
    std::vector<SectionFacts> all;
    for_each_section([&](const auto& section, auto) { all.push_back(facts_of(section)); });
    return all;
}

std::string text_from_number(double number) {
    const double exponent = std::log10(std::abs(number));
    if (exponent >= 4 && exponent == std::floor(exponent)) {
        return fmt::format("{}1e{:.0f}", number < 0 ? "-" : "", exponent);
    }
    return fmt::format("{:.7g}", number);
}

}  // namespace relume::wire
