// Laws of patches over random histories.
#include "protocol/wire/messages.h"
#include "protocol/wire/room_patch.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace relume::wire {
namespace {

using nlohmann::json;

double number(double lowest, double highest) {
    // Steps of 1/1000 of the range: decimal, as people and sliders make them.
    return lowest + (highest - lowest) * *rc::gen::inRange(0, 1001) / 1000.0;
}

json triple(double highest) {
    return {number(0, highest), number(0, highest), number(0, highest)};
}

json direction() {
    json d = {number(-2, 2), number(-2, 2), number(-2, 2)};
    if (d == json({0.0, 0.0, 0.0})) {
        d[1] = 1.0;
    }
    return d;
}

bool chance() {
    return *rc::gen::arbitrary<bool>();
}

std::string environment_name() {
    return *rc::gen::element<std::string>("city", "night", "studio", "sky");
}

json light_patch(bool is_new) {
    json light = json::object();
    if (is_new || chance()) {
        light["direction"] = direction();
    }
    if (is_new || chance()) {
        light["angular_radius_degrees"] = number(0.05, 90);
    }
    if (is_new || chance()) {
        light["radiance"] = triple(1e8);
    }
    if (chance()) {
        light["gain"] = number(0, 1e6);
    }
    if (chance()) {
        light["tint"] = triple(1e4);
    }
    if (chance()) {
        light["name"] = *rc::gen::element<json>("Fenster, links", "キー", nullptr);
    }
    for (const char* flag : {"muted", "solo"}) {
        if (chance()) {
            light[flag] = chance();
        }
    }
    if (chance()) {
        light["order"] = number(-10, 10);
    }
    return light;
}

json rotation_patch() {
    if (chance()) {
        return {
            {"quaternion", {number(0.001, 3), number(-2, 2), number(-2, 2), number(-2, 2)}}};
    }
    json rotation = {{"yaw_degrees", number(-720, 720)}};
    if (chance()) {
        rotation["pitch_degrees"] = number(-90, 90);
    }
    if (chance()) {
        rotation["roll_degrees"] = number(-180, 180);
    }
    return rotation;
}

// A patch that `state` takes.
json valid_patch(const RoomState& state) {
    json patch = json::object();
    if (chance()) {
        patch["environment"] = {{"gain", number(0, 1e6)}};
        if (chance()) {
            patch["environment"]["name"] = environment_name();
        }
    }
    if (chance()) {
        patch["blend"] = {{"name", chance() ? json(environment_name()) : json()},
                          {"amount", number(0, 1)}};
    }
    if (chance()) {
        patch["rotation"] = rotation_patch();
    }
    for (const char* id : {"a", "b", "c"}) {
        switch (*rc::gen::inRange(0, 4)) {
            case 0:
                patch["lights"][id] = nullptr;
                break;
            case 1:
                patch["lights"][id] = light_patch(!state.lights.contains(id));
                break;
            default:
                break;
        }
    }
    if (chance()) {
        patch["background"] = {
            {"mode", *rc::gen::element<std::string>("environment", "colour", "transparent")}};
    }
    if (chance()) {
        patch["strategy"] = {
            {"method", *rc::gen::element<std::string>("nwa", "bi", "pbi", "guarded")},
            {"priority",
             *rc::gen::element<std::string>("area", "none", "transport", "benefit")}};
    }
    if (chance()) {
        patch["budget"] = chance() ? json{{"coefficients", *rc::gen::inRange(1, 393217)}}
                                   : json{{"milliseconds", number(0.1, 1000)}};
    }
    if (chance()) {
        patch["display"] = {{"exposure_stops", number(-20, 20)}};
    }
    return patch;
}

// A state some edits away from the default one.
RoomState any_state() {
    RoomState state;
    for (int edits = *rc::gen::inRange(0, 3); edits > 0; --edits) {
        apply_patch(state, valid_patch(state), Limits{});
    }
    return state;
}

RC_GTEST_PROP(RoomPatchLaws, AStateSurvivesItsJson, ()) {
    const RoomState state = any_state();
    RC_ASSERT(room_state_from_json(json::parse(to_json(state).dump())) == state);
}

RC_GTEST_PROP(RoomPatchLaws, MergingTheNormalisedPatchIntoTheJsonIsApplyingIt, ()) {
    RoomState state = any_state();
    json object = to_json(state);
    object.merge_patch(apply_patch(state, valid_patch(state), Limits{}));
    RC_ASSERT(object == to_json(state));
}

RC_GTEST_PROP(RoomPatchLaws, ANormalisedPatchIsItsOwnNormalForm, ()) {
    RoomState state = any_state();
    RoomState other = state;
    const json normalised = apply_patch(state, valid_patch(state), Limits{});
    RC_ASSERT(apply_patch(other, normalised, Limits{}) == normalised);
    RC_ASSERT(other == state);
    apply_patch(state, normalised, Limits{});
    RC_ASSERT(other == state);
}

RC_GTEST_PROP(RoomPatchLaws, AMergedPatchHasTheEffectOfAllInTurn, ()) {
    const RoomState start = any_state();
    RoomState in_turn = start;
    json merged = json::object();
    for (int edits = *rc::gen::inRange(1, 6); edits > 0; --edits) {
        merged = merge_patches(merged, apply_patch(in_turn, valid_patch(in_turn), Limits{}));
    }
    RoomState at_once = start;
    apply_patch(at_once, merged, Limits{});
    RC_ASSERT(at_once == in_turn);
    json object = to_json(start);
    object.merge_patch(merged);
    RC_ASSERT(object == to_json(in_turn));
}

RC_GTEST_PROP(RoomPatchLaws, MergingIsAssociative, ()) {
    RoomState state = any_state();
    const json a = apply_patch(state, valid_patch(state), Limits{});
    const json b = apply_patch(state, valid_patch(state), Limits{});
    const json c = apply_patch(state, valid_patch(state), Limits{});
    RC_ASSERT(merge_patches(merge_patches(a, b), c) == merge_patches(a, merge_patches(b, c)));
}

// Replaces one random value inside `value` by one of a foreign kind.
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

RC_GTEST_PROP(RoomPatchLaws, ASpoiltPatchIsTakenWholeOrRefusedWhole, ()) {
    RoomState state = any_state();
    const RoomState before = state;
    json patch = valid_patch(state);
    spoil(patch);
    try {
        const json normalised = apply_patch(state, patch, Limits{});
        json object = to_json(before);
        object.merge_patch(normalised);
        RC_ASSERT(object == to_json(state));
    } catch (const WireError& error) {
        RC_ASSERT(state == before);
        RC_ASSERT(!error.found().empty());
        RC_ASSERT(!error.expected().empty());
        RC_ASSERT(error.path().empty() || error.path().front() == '/');
    }
}

}  // namespace
}  // namespace relume::wire
