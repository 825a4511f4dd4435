#include "tests/unit/wire/random_patches.h"

#include "protocol/wire/room_patch.h"
#include "protocol/wire/sections/room_sections.h"

#include <rapidcheck.h>

namespace relume::wire {
namespace {

using nlohmann::json;

double number(Range range) {
    // Steps of 1/1000 of the range: decimal, as people and sliders make them.
    return range.lowest + (range.highest - range.lowest) * *rc::gen::inRange(0, 1001) / 1000.0;
}

json numbers(std::size_t count, Range range) {
    json array = json::array();
    for (std::size_t i = 0; i < count; ++i) {
        array.push_back(number(range));
    }
    return array;
}

json not_all_zero(std::size_t count) {
    json array = numbers(count, {-2, 2});
    if (array == json(std::vector<double>(count, 0.0))) {
        array[0] = 1.0;
    }
    return array;
}

json value_of(const FieldRule& rule) {
    if (rule.presence == Presence::optional && chance()) {
        return nullptr;
    }
    switch (rule.kind) {
        case FieldKind::number:
            return number(rule.range);
        case FieldKind::integer:
            return *rc::gen::inRange(static_cast<int>(rule.range.lowest),
                                     static_cast<int>(rule.range.highest) + 1);
        case FieldKind::flag:
            return chance();
        case FieldKind::triple:
            return numbers(3, rule.range);
        case FieldKind::direction:
            return not_all_zero(3);
        case FieldKind::quaternion:
            return not_all_zero(4);
        case FieldKind::name:
            return *rc::gen::element<std::string>("city", "night", "studio", "sky");
        case FieldKind::label:
            return *rc::gen::element<std::string>("Fenster, links", "キー");
        case FieldKind::word:
            return *rc::gen::elementOf(
                std::vector<std::string>(rule.words.begin(), rule.words.end()));
        case FieldKind::table: {
            json rows = json::array();
            const auto count =
                *rc::gen::inRange(rule.table.least_rows, rule.table.most_rows + 1);
            for (std::uint32_t row = 0; row < count; ++row) {
                rows.push_back(numbers(rule.table.columns, rule.range));
            }
            return rows;
        }
    }
    return nullptr;
}

template <typename Owner>
json patch_of(const Section<Owner>& section, bool is_new) {
    json patch = json::object();
    if (!section.spelling.fields.empty() && chance()) {
        for (const FieldRule& rule : section.spelling.fields) {
            if (chance()) {
                patch[std::string(rule.key)] = value_of(rule);
            }
        }
        return patch;
    }
    bool has_one = false;
    for (const Field<Owner>& field : section.fields) {
        const FieldRule& rule = field.rule;
        const bool is_taken = rule.presence == Presence::one_of && has_one;
        if (!is_taken && ((is_new && rule.is_needed) || chance())) {
            patch[std::string(rule.key)] = value_of(rule);
            has_one = has_one || rule.presence == Presence::one_of;
        }
    }
    return patch;
}

template <typename Owner>
json patch_of(const Section<Owner>& section, const Owner&) {
    return patch_of(section, false);
}

template <typename Entry>
json patch_of(const KeyedSection<Entry>& section, const std::map<std::string, Entry>& entries) {
    json patch = json::object();
    for (const char* id : {"a", "b", "c"}) {
        switch (*rc::gen::inRange(0, 4)) {
            case 0:
                patch[id] = nullptr;
                break;
            case 1:
                patch[id] = patch_of(section.entry, !entries.contains(id));
                break;
            default:
                break;
        }
    }
    return patch;
}

}  // namespace

bool chance() {
    return *rc::gen::arbitrary<bool>();
}

json valid_patch(const RoomState& state) {
    json patch = json::object();
    for_each_section([&](const auto& section, const auto member) {
        if (chance()) {
            patch[std::string(fields_of(section).key)] = patch_of(section, state.*member);
        }
    });
    return patch;
}

RoomState any_state() {
    RoomState state;
    for (int edits = *rc::gen::inRange(0, 3); edits > 0; --edits) {
        apply_patch(state, valid_patch(state), Limits{});
    }
    return state;
}

void spoil(json& value) {
    if (value.is_structured() && !value.empty() && *rc::gen::inRange(0, 5) != 0) {
        auto at = value.begin();
        std::advance(at, *rc::gen::inRange<std::ptrdiff_t>(
                             0, static_cast<std::ptrdiff_t>(value.size())));
        spoil(*at);
        return;
    }
    value = *rc::gen::element<json>(nullptr, true, -1, 1e300, "x", "", json::array(),
                                    json::array({1, 2, 3, 4}), json::object(),
                                    json{{"unknown", 1}});
}

}  // namespace relume::wire
