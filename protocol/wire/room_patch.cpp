#include "protocol/wire/room_patch.h"

#include "protocol/wire/sections/room_sections.h"
#include "protocol/wire/sections/section_json.h"

#include <algorithm>

namespace relume::wire {
namespace {

using nlohmann::json;

// What a section holds of what `patch` names, null for what could be there and is not.
template <typename Owner>
json named_by(const json& /*patch*/, const Section<Owner>& section, const Owner& owner) {
    return to_json(section, owner, Absent::null);
}

// Of entries only those: there may be many.
template <typename Entry>
json named_by(const json& patch,
              const KeyedSection<Entry>& section,
              const std::map<std::string, Entry>& entries) {
    json named = json::object();
    for (const auto& [id, change] : patch.items()) {
        if (const auto known = entries.find(id); known != entries.end()) {
            named[id] = to_json(section.entry, known->second, Absent::null);
        }
    }
    return named;
}

// The merge patch that takes back what `patch` does to `before`.
json inverse_of(const json& patch, const json& before) {
    json inverse = json::object();
    for (const auto& [key, change] : patch.items()) {
        const auto was = before.find(key);
        if (was == before.end()) {
            inverse[key] = nullptr;
        } else if (change.is_object() && was->is_object()) {
            inverse[key] = inverse_of(change, *was);
        } else {
            inverse[key] = *was;
        }
    }
    return inverse;
}

}  // namespace

AppliedPatch apply_patch(RoomState& state, const json& patch, const Limits& limits) {
    RoomState next = state;
    ObjectReader reader(patch, "");
    AppliedPatch applied{.patch = json::object(), .inverse = json::object()};
    for_each_section([&](const auto& section, const auto member) {
        const std::string key(fields_of(section).key);
        const json* const change = reader.find(fields_of(section).key);
        if (change == nullptr) {
            return;
        }
        json normalised =
            patch_section(section, next.*member, *change, reader.path_to(key), limits);
        if (!normalised.empty()) {
            applied.inverse[key] =
                inverse_of(normalised, named_by(normalised, section, state.*member));
            applied.patch[key] = std::move(normalised);
        }
    });
    reader.refuse_other_keys();
    state = std::move(next);
    return applied;
}

void require_kept(const RoomState& before,
                  const RoomState& after,
                  std::span<const std::string> edits) {
    for_each_section([&](const auto& section, const auto member) {
        const std::string key(fields_of(section).key);
        if (after.*member != before.*member &&
            std::find(edits.begin(), edits.end(), key) == edits.end()) {
            throw WireError(
                ErrorCode::unsupported, "/" + key, quote(to_json(section, after.*member)),
                quote(to_json(section, before.*member)) + ", which rooms of this scene keep");
        }
    });
}

json merge_patches(json first, const json& second) {
    if (!first.is_object() || !second.is_object()) {
        return second;
    }
    for (const auto& [key, value] : second.items()) {
        const auto known = first.find(key);
        if (known == first.end()) {
            first[key] = value;
        } else {
            // Nulls stay: they remove what the state below still has.
            *known = merge_patches(std::move(*known), value);
        }
    }
    return first;
}

}  // namespace relume::wire
