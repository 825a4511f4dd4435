// A section from and to JSON, by its description: the whole of it, and patches of it.
#pragma once

#include "protocol/base/text/names.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/json_text.h"
#include "protocol/wire/object_reader.h"
#include "protocol/wire/sections/field_json.h"
#include "protocol/wire/sections/section.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace relume::wire {

enum class Absent : std::uint8_t { left_out, null };

template <typename Owner>
[[nodiscard]] nlohmann::json to_json(const Section<Owner>& section,
                                     const Owner& owner,
                                     Absent absent = Absent::left_out) {
    auto object = nlohmann::json::object();
    for (const Field<Owner>& field : section.fields) {
        auto value = json_from_value(field.get(owner));
        if (!value.is_null() || absent == Absent::null) {
            object[std::string(field.rule.key)] = std::move(value);
        }
    }
    return object;
}

template <typename Entry>
[[nodiscard]] nlohmann::json to_json(const KeyedSection<Entry>& section,
                                     const std::map<std::string, Entry>& entries) {
    auto object = nlohmann::json::object();
    for (const auto& [id, entry] : entries) {
        object[id] = to_json(section.entry, entry);
    }
    return object;
}

// Applies one patch of one section; throws WireError with paths below `path`, and `owner` may
// then be half changed. Returns the patch normalised.
template <typename Owner>
class SectionPatch {
  public:
    using json = nlohmann::json;

    SectionPatch(const Section<Owner>& section, const json& patch, std::string path)
        : section_(section), path_(std::move(path)), reader_(patch, path_) {}

    // Throws WireError{missing_field} where a new entry has to state a field and does not.
    void require_needed() {
        for (const Field<Owner>& field : section_.fields) {
            if (field.rule.is_needed) {
                static_cast<void>(reader_.require(field.rule.key));
            }
        }
    }

    [[nodiscard]] json apply(Owner& owner) {
        const std::vector<double> spelled = read_spelling();
        bool excludes = false;
        for (const Field<Owner>& field : section_.fields) {
            if (field.rule.presence == Presence::one_of) {
                if (!std::exchange(excludes, true)) {
                    apply_one_of(owner);
                }
            } else if (const json* stated = reader_.find(field.rule.key)) {
                take(field, *stated, owner);
            }
        }
        reader_.refuse_other_keys();
        if (!spelled.empty()) {
            apply_spelling(spelled, owner);
        }
        return std::move(normalised_);
    }

  private:
    void take(const Field<Owner>& field, const json& stated, Owner& owner) {
        const FieldRule& rule = field.rule;
        const FieldValue value = value_from_json(rule, stated, reader_.path_to(rule.key));
        field.set(owner, value);
        normalised_[std::string(rule.key)] = normal_form(rule, value, stated);
    }

    // Null is what takes the others away in a normalised patch; alone it would leave none.
    void apply_one_of(Owner& owner) {
        const Field<Owner>* chosen = nullptr;
        const json* chosen_value = nullptr;
        bool leaves_none = false;
        std::string keys;
        for (const Field<Owner>& field : section_.fields) {
            if (field.rule.presence != Presence::one_of) {
                continue;
            }
            keys.append(keys.empty() ? "" : " or ").append(field.rule.key);
            const json* const stated = reader_.find(field.rule.key);
            if (stated == nullptr) {
                continue;
            }
            if (stated->is_null()) {
                const bool is_set = !json_from_value(field.get(owner)).is_null();
                leaves_none = leaves_none || is_set;
            } else if (chosen != nullptr) {
                refuse_both(chosen->rule.key, field.rule.key);
            } else {
                chosen = &field;
                chosen_value = stated;
            }
        }
        if (chosen == nullptr) {
            if (leaves_none) {
                throw WireError(ErrorCode::missing_field, path_,
                                "null for the only one that is set", keys);
            }
            return;
        }
        for (const Field<Owner>& field : section_.fields) {
            if (field.rule.presence == Presence::one_of && &field != chosen) {
                field.set(owner, {});
                normalised_[std::string(field.rule.key)] = nullptr;
            }
        }
        take(*chosen, *chosen_value, owner);
    }

    // Empty where the patch has none of these fields.
    std::vector<double> read_spelling() {
        std::vector<double> numbers(section_.spelling.fields.size());
        bool is_used = false;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const FieldRule& rule = section_.spelling.fields[i];
            if (const json* stated = reader_.find(rule.key)) {
                numbers[i] = number_from_json(*stated, reader_.path_to(rule.key), rule.range);
                spelled_key_ = rule.key;
                is_used = true;
            }
        }
        return is_used ? numbers : std::vector<double>();
    }

    void apply_spelling(const std::vector<double>& numbers, Owner& owner) {
        if (!normalised_.empty()) {
            refuse_both(normalised_.begin().key(), spelled_key_);
        }
        owner = section_.spelling.meaning(numbers);
        normalised_ = to_json(section_, owner, Absent::null);
    }

    [[noreturn]] void refuse_both(std::string_view one, std::string_view other) const {
        throw WireError(ErrorCode::unsupported, path_,
                        std::string(one).append(" and ").append(other), "one or the other");
    }

    const Section<Owner>& section_;
    std::string path_;
    ObjectReader reader_;
    std::string_view spelled_key_;
    json normalised_ = json::object();
};

template <typename Owner>
[[nodiscard]] nlohmann::json patch_section(const Section<Owner>& section,
                                           Owner& owner,
                                           const nlohmann::json& patch,
                                           const std::string& path,
                                           const Limits& /*limits*/) {
    return SectionPatch<Owner>(section, patch, path).apply(owner);
}

// A new entry comes with all its fields, null for those it has not: merged over the removal of
// an entry that had them, the null takes them away.
template <typename Entry>
[[nodiscard]] nlohmann::json patch_section(const KeyedSection<Entry>& section,
                                           std::map<std::string, Entry>& entries,
                                           const nlohmann::json& patch,
                                           const std::string& path,
                                           const Limits& limits) {
    using nlohmann::json;
    if (!patch.is_object()) {
        throw WireError(ErrorCode::wrong_type, path, quote(patch),
                        "an object of " + std::string(section.nouns));
    }
    json normalised = json::object();
    for (const auto& [id, change] : patch.items()) {
        const std::string entry_path = pointer_step(path, id);
        if (!text::is_name(id)) {
            throw WireError(ErrorCode::out_of_range, entry_path, quote(json(id)),
                            "an id: " + std::string(text::kNameRule));
        }
        if (change.is_null()) {
            // What is not there cannot be removed, and clients need not hear of it.
            if (entries.erase(id) != 0) {
                normalised[id] = nullptr;
            }
            continue;
        }
        SectionPatch<Entry> entry_patch(section.entry, change, entry_path);
        const auto known = entries.find(id);
        if (known == entries.end()) {
            entry_patch.require_needed();
            Entry fresh = section.fresh(entries);
            static_cast<void>(entry_patch.apply(fresh));
            normalised[id] = to_json(section.entry, fresh, Absent::null);
            entries.emplace(id, std::move(fresh));
        } else if (json changed = entry_patch.apply(known->second); !changed.empty()) {
            normalised[id] = std::move(changed);
        }
    }
    if (entries.size() > limits.*section.most) {
        throw WireError(ErrorCode::too_many, path,
                        std::to_string(entries.size()) + " " + std::string(section.nouns),
                        "at most " + std::to_string(limits.*section.most));
    }
    return normalised;
}

}  // namespace relume::wire
