#include "protocol/wire/room_state.h"

#include "protocol/wire/room_patch.h"
#include "protocol/wire/sections/room_sections.h"
#include "protocol/wire/sections/section_json.h"

namespace relume::wire {

nlohmann::json to_json(const RoomState& state) {
    auto object = nlohmann::json::object();
    for_each_section([&](const auto& section, const auto member) {
        object[std::string(fields_of(section).key)] = to_json(section, state.*member);
    });
    return object;
}

RoomState room_state_from_json(const nlohmann::json& object) {
    RoomState state;
    Limits limits;
    limits.lights_per_room = kMaxInteger;  // the server that sent it enforces its own
    limits.materials_per_room = kMaxInteger;
    static_cast<void>(apply_patch(state, object, limits));
    return state;
}

}  // namespace relume::wire
