// Materials given to parts of a scene: as options, as a step of a sequence, and as load.
#include "client/cli/edit_options.h"
#include "client/cli/finish_change.h"
#include "client/cli/finish_drag.h"
#include "client/cli/finish_options.h"
#include "protocol/base/program/usage.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/room_patch.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace relume::cli {
namespace {

using nlohmann::json;

TEST(FinishOptions, StateMaterialNumberAndColours) {
    EXPECT_EQ(finishes_from_options({}), json::object());
    EXPECT_FALSE(patch_from_options({}, "").contains("finishes"));
    EXPECT_EQ(finishes_from_options(
                  {"floor=phong@12.5:1,0.8,0.5", "wall=gold", "box=ggx@0.2:1,0,0:0,1,0:0,0,1"}),
              json::parse(R"({"floor": {"material": "phong", "parameter": 12.5,
                                        "colours": [[1, 0.8, 0.5]]},
                              "wall": {"material": "gold"},
                              "box": {"material": "ggx", "parameter": 0.2,
                                      "colours": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}})"));
    EditOptions options;
    options.finishes = {"floor=gold"};
    EXPECT_EQ(patch_from_options(options, "").at("finishes"),
              json::parse(R"({"floor": {"material": "gold"}})"));
}

TEST(FinishOptions, RefusesOtherForms) {
    for (const char* option : {"floor", "floor=", "=gold", "floor=phong@", "floor=phong@x",
                               "floor=gold:", "floor=gold:1,2", "floor=gold:1,2,3:"}) {
        EXPECT_THROW(static_cast<void>(finishes_from_options({option})), program::UsageError)
            << option;
    }
}

FinishChange change_from(const char* text) {
    const json value = json::parse(text);
    wire::ObjectReader reader(value, "/finish");
    return finish_change_from(reader);
}

TEST(FinishChange, GoesByEqualFactorsAndEqualParts) {
    const FinishChange change = change_from(
        R"({"part": "floor", "material": "phong", "parameter": [4, 64],
            "colours": [[[1, 0, 0]], [[0, 0, 1]]]})");
    const auto at = [&](double way) { return change.patch_at(way).at("finishes").at("floor"); };
    EXPECT_EQ(at(0).at("parameter"), 4.0);
    EXPECT_NEAR(at(0.5).at("parameter").get<double>(), 16, 1e-12);
    EXPECT_EQ(at(1).at("parameter"), 64.0);
    EXPECT_EQ(at(0.5).at("colours"), json::parse("[[0.5, 0.0, 0.5]]"));
    EXPECT_EQ(at(0.5).at("material"), "phong");
    EXPECT_FALSE(change_from(R"({"part": "a", "material": "b", "parameter": [1, 2]})")
                     .patch_at(0)
                     .at("finishes")
                     .at("a")
                     .contains("colours"));
}

TEST(FinishChange, NamesWhatIsWrong) {
    const auto refused = [](const char* text) {
        try {
            static_cast<void>(change_from(text));
        } catch (const wire::WireError& error) {
            return error.path();
        }
        return std::string("taken");
    };
    EXPECT_EQ(refused(R"({"material": "b", "parameter": [1, 2]})"), "/finish/part");
    EXPECT_EQ(refused(R"({"part": "a", "parameter": [1, 2]})"), "/finish/material");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b"})"), "/finish/part");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b", "parameter": 3})"),
              "/finish/parameter");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b", "parameter": [0, 3]})"),
              "/finish/parameter/0");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b", "colours": [[[1, 1, 1]], []]})"),
              "/finish/colours/1");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b",
                          "colours": [[[1, 1, 1]], [[1, 1, 1], [1, 1, 1]]]})"),
              "/finish/colours");
    EXPECT_EQ(refused(R"({"part": "a", "material": "b", "colours": [[[1, 1, 1]], [[1, 1]]]})"),
              "/finish/colours/1/0");
}

wire::SceneSummary scene() {
    wire::SceneSummary scene;
    scene.visibility_resolution = 64;
    scene.parts = {{.id = "floor", .name = "Floor"}, {.id = "wall", .name = "Wall"}};
    scene.camera = wire::Camera{.eye = {0, 2, 5}, .look_at = {0, 1, 0}};
    scene.bounds = wire::SceneBounds{.centre = {0, 1, 0}, .radius = 3};
    return scene;
}

wire::OfferedMaterial material(const char* name, std::uint32_t n) {
    return {.name = name, .face_resolution = n, .colours = {Imath::V3d(1, 0.5, 0.25)}};
}

TEST(FinishDrag, MovesLightCameraAndMaterials) {
    wire::OfferedMaterial phong = material("phong", 64);
    phong.parameter = "exponent";
    phong.steps = {4, 16, 64};
    FinishDrag drag(scene(), {material("white", 64), phong}, 7);
    wire::RoomState state;
    std::set<std::string> parts;
    std::set<std::string> materials;
    for (int i = 0; i < 600; ++i) {
        const json patch = drag.next();
        wire::apply_patch(state, patch, {});  // every edit is one that a server takes
        for (const auto& [part, finish] : patch.at("finishes").items()) {
            parts.insert(part);
            materials.insert(finish.at("material").get<std::string>());
            if (finish.contains("parameter")) {
                EXPECT_GE(finish.at("parameter").get<double>(), 4);
                EXPECT_LE(finish.at("parameter").get<double>(), 64);
            }
        }
        EXPECT_NEAR((state.camera.eye - Imath::V3d(0, 1, 0)).length(), std::sqrt(26.0), 1e-9);
    }
    EXPECT_EQ(parts, (std::set<std::string>{"floor", "wall"}));
    EXPECT_EQ(materials, (std::set<std::string>{"phong", "white"}));

    FinishDrag a(scene(), {phong}, 5);
    FinishDrag b(scene(), {phong}, 5);
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(a.next(), b.next());
    }
}

TEST(FinishDrag, TakesMaterialsOfTheScenesResolution) {
    const auto fitting = materials_for(scene(), {material("a", 32), material("b", 64)});
    ASSERT_EQ(fitting.size(), 1U);
    EXPECT_EQ(fitting[0].name, "b");
    EXPECT_TRUE(materials_for({}, {material("a", 64)}).empty());
}

}  // namespace
}  // namespace relume::cli
