#include "protocol/wire/messages.h"

#include "tests/unit/wire/vectors.h"

#include <gtest/gtest.h>

namespace relume::wire {
namespace {

using nlohmann::json;

WireError refusal_of(const std::string& text) {
    return wire_error_of([&] { return parse_client_message(text, Limits{}); });
}

WireError server_refusal_of(const json& message) {
    return wire_error_of([&] { return parse_server_message(message.dump()); });
}

TEST(ClientMessages, RoundTrip) {
    const Edit edit{.id = kMaxInteger, .patch = {{"environment", {{"gain", 0.1}}}}};
    const auto parsed = std::get<Edit>(parse_client_message(text_from_message(edit), Limits{}));
    EXPECT_EQ(parsed.id, edit.id);
    EXPECT_EQ(parsed.patch, edit.patch);
    const auto ack =
        std::get<Ack>(parse_client_message(text_from_message(Ack{.sequence = 42}), Limits{}));
    EXPECT_EQ(ack.sequence, 42U);
}

TEST(ClientMessages, ADisplayIsWhatIsChosenAndElseTheRooms) {
    const DisplayChoice choice{.exposure_stops = {}, .tone = Tone::linear};
    EXPECT_EQ(
        std::get<DisplayChoice>(parse_client_message(text_from_message(choice), Limits{})),
        choice);
    EXPECT_EQ(std::get<DisplayChoice>(parse_client_message(R"({"type":"display"})", Limits{})),
              DisplayChoice{});
    const Display room{.exposure_stops = 3, .tone = Tone::filmic};
    EXPECT_EQ(display_from_choice({}, room), room);
    EXPECT_EQ(display_from_choice(choice, room),
              (Display{.exposure_stops = 3, .tone = Tone::linear}));
    EXPECT_EQ(display_from_choice({.exposure_stops = -1, .tone = {}}, room),
              (Display{.exposure_stops = -1, .tone = Tone::filmic}));
}

TEST(ClientMessages, FaultsAreNamedByCodeAndPath) {
    struct Case {
        const char* text;
        ErrorCode code;
        const char* path;
    };
    for (const Case& c : {
             Case{"[]", ErrorCode::wrong_type, ""},
             Case{"{}", ErrorCode::missing_field, "/type"},
             Case{R"({"type":1})", ErrorCode::wrong_type, "/type"},
             Case{R"({"type":"Edit"})", ErrorCode::unknown_type, "/type"},
             Case{R"({"type":"display","exposure_stops":21})", ErrorCode::out_of_range,
                  "/exposure_stops"},
             Case{R"({"type":"display","tone":"Filmic"})", ErrorCode::out_of_range, "/tone"},
             Case{R"({"type":"display","tone":1})", ErrorCode::wrong_type, "/tone"},
             Case{R"({"type":"display","gain":1})", ErrorCode::unknown_field, "/gain"},
             Case{R"({"type":"edit","patch":{}})", ErrorCode::missing_field, "/id"},
             Case{R"({"type":"edit","id":-1,"patch":{}})", ErrorCode::out_of_range, "/id"},
             Case{R"({"type":"edit","id":9007199254740992,"patch":{}})",
                  ErrorCode::out_of_range, "/id"},
             Case{R"({"type":"edit","id":1.5,"patch":{}})", ErrorCode::wrong_type, "/id"},
             Case{R"({"type":"edit","id":"1","patch":{}})", ErrorCode::wrong_type, "/id"},
             Case{R"({"type":"edit","id":1})", ErrorCode::missing_field, "/patch"},
             Case{R"({"type":"edit","id":1,"patch":null})", ErrorCode::wrong_type, "/patch"},
             Case{R"({"type":"edit","id":1,"patch":{},"x":0})", ErrorCode::unknown_field, "/x"},
             Case{R"({"type":"ack"})", ErrorCode::missing_field, "/sequence"},
             Case{R"({"type":"ack","sequence":true})", ErrorCode::wrong_type, "/sequence"},
             Case{R"({"type":"ack","sequence":1e400})", ErrorCode::out_of_range, ""},
             Case{R"({"type":"ack","sequence":1,"id":1})", ErrorCode::unknown_field, "/id"},
             Case{R"({"type":"ack","sequence":1,"sequence":2})", ErrorCode::malformed_json, ""},
         }) {
        const WireError error = refusal_of(c.text);
        EXPECT_EQ(error.code(), c.code) << c.text;
        EXPECT_EQ(error.path(), c.path) << c.text;
        EXPECT_FALSE(error.found().empty());
        EXPECT_FALSE(error.expected().empty());
    }
}

TEST(ClientMessages, ARefusedEditKeepsItsIdOnceItWasRead) {
    EXPECT_EQ(refusal_of(R"({"type":"edit","id":17,"patch":3})").edit_id(), 17U);
    EXPECT_EQ(refusal_of(R"({"type":"edit","id":17,"patch":{},"x":0})").edit_id(), 17U);
    EXPECT_EQ(refusal_of(R"({"type":"edit","id":"a"})").edit_id(), std::nullopt);
}

TEST(ClientMessages, TheLimitIsThatOfTheLimits) {
    Limits limits;
    const std::string text = text_from_message(Ack{.sequence = 1});
    limits.message_bytes = text.size();
    EXPECT_NO_THROW(static_cast<void>(parse_client_message(text, limits)));
    limits.message_bytes = text.size() - 1;
    EXPECT_EQ(wire_error_of([&] { return parse_client_message(text, limits); }).code(),
              ErrorCode::too_large);
}

Snapshot busy_snapshot() {
    Snapshot snapshot{.room = "studio",
                      .scene = {.name = "table",
                                .kind = "image",
                                .width = 512,
                                .height = 384,
                                .basis = "sh",
                                .order = 10,
                                .face_resolution = 64,
                                .columns = 100,
                                .channels = 3,
                                .bytes = 1U << 20,
                                .memory_bytes = 3U << 20,
                                .bake_error = 0.008,
                                .camera = Camera{.eye = {1e6, 0.1, -3}, .fov_degrees = 0.01},
                                .bounds = SceneBounds{.centre = {1, 2, 3}, .radius = 0.7},
                                .edits = {"environment", "lights"}},
                      .revision = 7,
                      .state = {},
                      .viewers = 2,
                      .limits = {}};
    snapshot.limits.rooms = 3;
    snapshot.state.environment = {.name = "city", .gain = 0.1, .tint = {0.3, 0.2, 0.1}};
    snapshot.state.blend = {.name = "night", .amount = 0.7};
    snapshot.state.rotation.quaternion = quaternion_from_yaw_pitch_roll_degrees(30, 20, 10);
    snapshot.state.lights["key"] = {.direction = {0.6, 0, 0.8},
                                    .angular_radius_degrees = 3.3,
                                    .radiance = {1e8, 0, 0.1},
                                    .gain = 0.9,
                                    .tint = {1, 0.9, 0.8}};
    snapshot.state.budget = {
        .milliseconds = std::nullopt, .coefficients = 30, .target_error = 0.01};
    snapshot.state.display = {.exposure_stops = -1.1, .tone = Tone::linear};
    return snapshot;
}

TEST(ServerMessages, SnapshotRoundTrip) {
    const Snapshot snapshot = busy_snapshot();
    const auto parsed = std::get<Snapshot>(parse_server_message(text_from_message(snapshot)));
    EXPECT_EQ(parsed.room, snapshot.room);
    EXPECT_EQ(parsed.scene, snapshot.scene);
    EXPECT_EQ(parsed.revision, snapshot.revision);
    EXPECT_EQ(parsed.state, snapshot.state);
    EXPECT_EQ(parsed.viewers, snapshot.viewers);
    EXPECT_EQ(parsed.limits, snapshot.limits);
}

TEST(ServerMessages, ASnapshotMustBeWholeAndOfThisVersion) {
    const json good = json::parse(text_from_message(busy_snapshot()));
    for (const char* key :
         {"protocol", "room", "scene", "revision", "state", "viewers", "limits"}) {
        json bad = good;
        bad.erase(key);
        EXPECT_EQ(server_refusal_of(bad).code(), ErrorCode::missing_field) << key;
    }
    json newer = good;
    newer["protocol"] = 2;
    EXPECT_EQ(server_refusal_of(newer).code(), ErrorCode::unsupported);
}

TEST(ServerMessages, WhatANewerServerSaysMoreOfTheStateIsIgnored) {
    json snapshot = json::parse(text_from_message(busy_snapshot()));
    const RoomState state = busy_snapshot().state;
    snapshot["state"]["atmosphere"] = {{"haze", {0, 1, 2}}};
    snapshot["state"]["camera"]["shutter"] = 0.5;
    snapshot["state"]["environment"]["horizon"] = 0.5;
    for (json& light : snapshot["state"]["lights"]) {
        light["falloff"] = "square";
    }
    EXPECT_EQ(std::get<Snapshot>(parse_server_message(snapshot.dump())).state, state);

    const json patch = {{"rotation", {{"yaw_degrees", 90}}}, {"lights", {{"key", nullptr}}}};
    json more = patch;
    more["atmosphere"] = nullptr;
    more["rotation"]["about"] = "y";
    const json change = {{"type", "change"}, {"revision", 9}, {"patch", more}};
    EXPECT_EQ(std::get<Change>(parse_server_message(change.dump())).patch, patch);
    // What is not of its type is refused still.
    snapshot["state"]["lights"] = 3;
    EXPECT_EQ(server_refusal_of(snapshot).code(), ErrorCode::wrong_type);
}

TEST(ServerMessages, ChangeErrorAndViewersRoundTrip) {
    const Change change{.revision = 8, .patch = {{"lights", {{"a", nullptr}}}}, .edit_id = 17};
    const auto parsed = std::get<Change>(parse_server_message(text_from_message(change)));
    EXPECT_EQ(parsed.revision, 8U);
    EXPECT_EQ(parsed.patch, change.patch);
    EXPECT_EQ(parsed.edit_id, 17U);

    const WireError refusal =
        WireError(ErrorCode::out_of_range, "/blend/amount", "2", "a number 0 … 1")
            .with_edit_id(3);
    const auto error = std::get<ErrorMessage>(
        parse_server_message(text_from_message(message_from_error(refusal))));
    EXPECT_EQ(error.code, refusal.code());
    EXPECT_EQ(error.message, refusal.what());
    EXPECT_EQ(error.path, refusal.path());
    EXPECT_EQ(error.found, refusal.found());
    EXPECT_EQ(error.expected, refusal.expected());
    EXPECT_EQ(error.edit_id, 3U);

    EXPECT_EQ(
        std::get<Viewers>(parse_server_message(text_from_message(Viewers{.count = 5}))).count,
        5U);
    const auto anonymous = std::get<Change>(parse_server_message(
        text_from_message(Change{.revision = 9, .patch = json::object(), .edit_id = {}})));
    EXPECT_EQ(anonymous.edit_id, std::nullopt);
}

TEST(ServerMessages, AClientIgnoresFieldsItDoesNotKnow) {
    EXPECT_EQ(
        std::get<Viewers>(parse_server_message(R"({"type":"viewers","count":5,"names":["a"]})"))
            .count,
        5U);
    EXPECT_EQ(server_refusal_of({{"type", "weather"}}).code(), ErrorCode::unknown_type);
}

TEST(ServerMessages, TextThatIsNotUtf8StillMakesJson) {
    ErrorMessage message;
    message.message = "file \xff\xfe.hdr";
    EXPECT_NO_THROW(static_cast<void>(parse_server_message(text_from_message(message))));
    const WireError error(ErrorCode::bad_image, "", "\xff", "an image");
    EXPECT_EQ(json::parse(http_body_from_error(error)).at("error").at("code"), "bad_image");
}

TEST(SceneSummary, AnOlderServerSaysLess) {
    const nlohmann::json object = {
        {"name", "table"}, {"width", 8}, {"height", 4}, {"face_resolution", 16}};
    const SceneSummary scene = scene_summary_from_json(object, "/scene");
    EXPECT_EQ(scene.name, "table");
    EXPECT_EQ(scene.face_resolution, 16U);
    EXPECT_FALSE(scene.bake_error);
    for (const char* key : {"name", "width", "height", "face_resolution"}) {
        nlohmann::json without = object;
        without.erase(key);
        EXPECT_EQ(
            wire_error_of([&] { return scene_summary_from_json(without, "/scene"); }).code(),
            ErrorCode::missing_field)
            << key;
    }
}

TEST(SceneSummary, WrongTypesAreNamedByTheirPath) {
    const nlohmann::json object = to_json(busy_snapshot().scene);
    for (const auto& [key, value] : object.items()) {
        nlohmann::json wrong = object;
        wrong[key] = key == "edits" ? nlohmann::json{1} : nlohmann::json{{"a", 1}};
        const std::string path =
            wire_error_of([&] { return scene_summary_from_json(wrong, "/scene"); }).path();
        // Of an object, the first field that is missed.
        const std::string inside = key == "edits"    ? "/0"
                                   : key == "camera" ? "/eye"
                                   : key == "bounds" ? "/centre"
                                                     : "";
        EXPECT_EQ(path, "/scene/" + key + inside);
    }
}

}  // namespace
}  // namespace relume::wire
