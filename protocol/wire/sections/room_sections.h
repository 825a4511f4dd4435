// All sections of the room's state, in the order of the contract.
#pragma once

#include "protocol/wire/room_state.h"
#include "protocol/wire/sections/budget.h"
#include "protocol/wire/sections/strategy.h"

namespace relume::wire {

// Calls visit(description, member of RoomState) for each.
template <typename Visit>
void for_each_section(Visit&& visit) {
    visit(kEnvironment, &RoomState::environment);
    visit(kBlend, &RoomState::blend);
    visit(kRotation, &RoomState::rotation);
    visit(kAreaLights, &RoomState::lights);
    visit(kMaterials, &RoomState::materials);
    visit(kFinishes, &RoomState::finishes);
    visit(kBackground, &RoomState::background);
    visit(kCamera, &RoomState::camera);
    visit(kImageSize, &RoomState::image);
    visit(kStrategy, &RoomState::strategy);
    visit(kBudget, &RoomState::budget);
    visit(kDisplay, &RoomState::display);
}

template <typename Owner>
[[nodiscard]] constexpr const Section<Owner>& fields_of(const Section<Owner>& section) {
    return section;
}
template <typename Entry>
[[nodiscard]] constexpr const Section<Entry>& fields_of(const KeyedSection<Entry>& section) {
    return section.entry;
}

}  // namespace relume::wire
