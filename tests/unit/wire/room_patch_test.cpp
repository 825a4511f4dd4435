#include "protocol/wire/room_patch.h"

#include "protocol/basis/cubemap.h"
#include "protocol/wire/sections/budget.h"
#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relume::wire {
namespace {

using nlohmann::json;

// Equal but for rounding in the last digits of a number.
bool nearly_equal(const json& a, const json& b) {
    if (a.is_number() && b.is_number()) {
        const auto x = a.get<double>();
        const auto y = b.get<double>();
        return std::abs(x - y) <= 1e-12 * std::max({1.0, std::abs(x), std::abs(y)});
    }
    if (a.type() != b.type() || a.size() != b.size()) {
        return false;
    }
    if (a.is_object()) {
        for (const auto& [key, value] : a.items()) {
            if (!b.contains(key) || !nearly_equal(value, b.at(key))) {
                return false;
            }
        }
        return true;
    }
    if (a.is_array()) {
        return std::equal(a.begin(), a.end(), b.begin(), nearly_equal);
    }
    return a == b;
}

TEST(RoomPatch, SharedCases) {
    for (const auto& c : vectors_from_file("patches")) {
        SCOPED_TRACE(c.at("name"));
        RoomState state = room_state_from_json(c.at("state"));
        EXPECT_TRUE(nearly_equal(to_json(state), c.at("state"))) << to_json(state);
        const RoomState before = state;
        if (c.contains("error")) {
            const WireError error =
                wire_error_of([&] { return apply_patch(state, c.at("patch"), Limits{}); });
            EXPECT_EQ(name_from_error_code(error.code()), c.at("error").at("code"));
            EXPECT_EQ(error.path(), c.at("error").at("path"));
            EXPECT_FALSE(error.found().empty());
            EXPECT_FALSE(error.expected().empty());
            EXPECT_EQ(state, before);
        } else {
            const json normalised = apply_patch(state, c.at("patch"), Limits{}).patch;
            EXPECT_TRUE(nearly_equal(normalised, c.at("normalised"))) << normalised;
            EXPECT_TRUE(nearly_equal(to_json(state), c.at("result"))) << to_json(state);
        }
    }
}

TEST(RoomPatch, NumbersReadBackAsTheyWereSet) {
    RoomState state;
    apply_patch(state, {{"environment", {{"gain", 0.1}, {"tint", {0.2, 0.3, 0.7}}}}}, Limits{});
    const json object = to_json(state);
    EXPECT_EQ(object.at("environment").at("gain").dump(), "0.1");
    EXPECT_EQ(object.at("environment").at("tint").dump(), "[0.2,0.3,0.7]");
}

TEST(RoomPatch, LightsAreBoundedAfterTheWholePatch) {
    const json light = {
        {"direction", {0, 1, 0}}, {"angular_radius_degrees", 5}, {"radiance", {1, 1, 1}}};
    Limits limits;
    limits.lights_per_room = 2;
    RoomState state;
    apply_patch(state, {{"lights", {{"a", light}, {"b", light}}}}, limits);
    const WireError error = wire_error_of([&] {
        return apply_patch(state, {{"lights", {{"c", light}}}}, limits);
    });
    EXPECT_EQ(error.code(), ErrorCode::too_many);
    EXPECT_EQ(error.path(), "/lights");
    EXPECT_EQ(state.lights.size(), 2U);
    apply_patch(state, {{"lights", {{"a", light}, {"b", nullptr}, {"c", light}}}}, limits);
    EXPECT_EQ(state.lights.size(), 2U);
    EXPECT_TRUE(state.lights.contains("c"));
}

TEST(RoomPatch, DirectionsOfAnyMagnitudeBecomeUnitVectors) {
    for (const double scale : {1e-320, 1e-200, 0.5, 1.0, 3.0, 1e200, 1.7e308}) {
        RoomState state;
        apply_patch(state,
                    {{"lights",
                      {{"a",
                        {{"direction", {scale, -scale, 0.0}},
                         {"angular_radius_degrees", 5},
                         {"radiance", {1, 1, 1}}}}}}},
                    Limits{});
        const Imath::V3d direction = state.lights.at("a").direction;
        EXPECT_NEAR(direction.x, std::sqrt(0.5), 1e-12) << scale;
        EXPECT_NEAR(direction.y, -std::sqrt(0.5), 1e-12) << scale;
        EXPECT_EQ(direction.z, 0) << scale;
    }
}

TEST(RoomPatch, AnglesTurnTheWayTheContractSays) {
    RoomState state;
    // Yaw +90° about +Y takes the source's −Z (its centre) to −X; then pitch acts before yaw.
    apply_patch(state, {{"rotation", {{"yaw_degrees", 90}}}}, Limits{});
    EXPECT_TRUE(state.rotation.quaternion.rotateVector({0, 0, -1})
                    .equalWithAbsError({-1, 0, 0}, 1e-12));
    apply_patch(state, {{"rotation", {{"yaw_degrees", 90}, {"pitch_degrees", 90}}}}, Limits{});
    EXPECT_TRUE(
        state.rotation.quaternion.rotateVector({0, 0, -1}).equalWithAbsError({0, 1, 0}, 1e-12));
    EXPECT_TRUE(
        state.rotation.quaternion.rotateVector({0, 1, 0}).equalWithAbsError({1, 0, 0}, 1e-12));
}

TEST(RoomPatch, AnInverseIsTheOldValuesOfWhatThePatchNames) {
    RoomState state;
    const json light = {
        {"direction", {0, 1, 0}}, {"angular_radius_degrees", 5}, {"radiance", {1, 1, 1}}};
    const auto inverse = [&](const json& patch) {
        return apply_patch(state, patch, Limits{}).inverse;
    };
    EXPECT_EQ(inverse({{"lights", {{"key", light}}}}), json({{"lights", {{"key", nullptr}}}}));
    EXPECT_EQ(inverse({{"lights", {{"key", {{"gain", 3}, {"name", "Window"}}}}}}),
              json({{"lights", {{"key", {{"gain", 1}, {"name", nullptr}}}}}}));
    EXPECT_EQ(inverse({{"budget", {{"coefficients", 30}}}}),
              json({{"budget", {{"milliseconds", 8}, {"coefficients", nullptr}}}}));
    EXPECT_EQ(inverse({{"rotation", {{"yaw_degrees", 90}}}}),
              json({{"rotation", {{"quaternion", {1, 0, 0, 0}}}}}));
    // A light comes back whole, and what names no difference takes none back.
    EXPECT_EQ(inverse({{"lights", {{"key", nullptr}, {"fill", nullptr}}}}),
              json({{"lights",
                     {{"key",
                       {{"direction", {0, 1, 0}},
                        {"angular_radius_degrees", 5},
                        {"radiance", {1, 1, 1}},
                        {"gain", 3},
                        {"tint", {1, 1, 1}},
                        {"name", "Window"},
                        {"muted", false},
                        {"solo", false},
                        {"order", 0}}}}}}));
    EXPECT_EQ(inverse({{"display", json::object()}}), json::object());
}

TEST(RoomPatch, ABudgetMayHoldAllColumnsOfTheLargestBasis) {
    EXPECT_EQ(kMostColumns,
              basis::kFaceCount * basis::kMaxFaceResolution * basis::kMaxFaceResolution);
    RoomState state;
    apply_patch(state, {{"budget", {{"coefficients", kMostColumns}}}}, Limits{});
    EXPECT_EQ(state.budget.coefficients, kMostColumns);
}

TEST(RoomPatch, AStoredStateThatLacksSectionsHasTheirDefaults) {
    const RoomState stored = room_state_from_json({{"environment", {{"name", "city"}}}});
    RoomState expected;
    expected.environment.name = "city";
    EXPECT_EQ(stored, expected);
    EXPECT_EQ(room_state_from_json(json::object()), RoomState{});
    const WireError error = wire_error_of([] {
        return room_state_from_json({{"atmosphere", json::object()}});
    });
    EXPECT_EQ(error.code(), ErrorCode::unknown_field);
    EXPECT_EQ(error.path(), "/atmosphere");
}

}  // namespace
}  // namespace relume::wire
