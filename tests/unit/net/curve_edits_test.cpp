// Materials edited as people do it, and the samples that come of it.
#include "server/net/rooms/curve_edits.h"

#include "protocol/curve/control_points.h"
#include "protocol/curve/curve_brdf.h"
#include "protocol/curve/curve_json.h"
#include "protocol/curve/stroke.h"
#include "protocol/wire/errors.h"
#include "protocol/wire/room_patch.h"
#include "server/net/library/editable_materials.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace relume::net {
namespace {

using nlohmann::json;

transport::CurveRecord record_of(const std::string& id,
                                 const curve::CurveBrdf& brdf,
                                 const std::string& curve) {
    const curve::BrdfCurve& edited = brdf.curves()[brdf.index_of(std::string_view(curve))];
    return {.id = id,
            .name = id,
            .curve = curve,
            .angle = std::string(curve::kCurveAngleNames.name(edited.angle)),
            .brdf = curve::json_from_curve_brdf(brdf),
            .baked = edited.curve.rgb};
}

class CurveEdits : public testing::Test {
  protected:
    CurveEdits()
        : curves_{
              record_of(
                  "pearl", curve::CurveBrdf::ggx(Imath::V3f(0.04F), 1, 0.2F), "distribution"),
              record_of(
                  "post",
                  curve::CurveBrdf::cook_torrance(0.1F, Imath::V3f(1.5F), Imath::V3f(0.0F)),
                  "fresnel")} {}

    // Applies a patch of one material as a room does, and gives the material's entry.
    wire::MaterialEdit edit(const std::string& id, const json& change) {
        const json patch =
            with_samples({{"materials", {{id, change}}}}, state_.materials, curves_);
        wire::apply_patch(state_, patch, {});
        return state_.materials.at(id);
    }
    std::string refusal(const json& materials) {
        try {
            static_cast<void>(
                with_samples({{"materials", materials}}, state_.materials, curves_));
        } catch (const wire::WireError& error) {
            return std::string(error.path()) + " found " + error.found() + " expected " +
                   error.expected();
        }
        return "taken";
    }
    static void expect_near(const wire::NumberTable& samples, const curve::Curve& curve) {
        const wire::NumberTable expected = samples_from_curve(curve);
        ASSERT_EQ(samples.numbers.size(), expected.numbers.size());
        for (std::size_t i = 0; i < samples.numbers.size(); ++i) {
            ASSERT_EQ(samples.numbers[i], expected.numbers[i]) << i;
        }
    }

    std::vector<transport::CurveRecord> curves_;
    wire::RoomState state_;
};

TEST_F(CurveEdits, ADiffuseColourAloneKeepsTheCurveAsBaked) {
    const wire::MaterialEdit pearl = edit("pearl", {{"diffuse", {0.5, 0.2, 0.1}}});
    expect_near(pearl.samples, {curves_[0].baked});
    EXPECT_EQ(pearl.diffuse, Imath::V3d(0.5, 0.2, 0.1));
    EXPECT_EQ(pearl.shape, curve::CurveShape::ggx);
    EXPECT_FLOAT_EQ(static_cast<float>(pearl.roughness), 0.2F);
}

TEST_F(CurveEdits, AParameterMovesTheCurveOfTheShapeThatTheMaterialHas) {
    wire::MaterialEdit pearl = edit("pearl", {{"roughness", 0.05}});
    expect_near(
        pearl.samples,
        curve::ShapedCurve{curve::CurveShape::ggx, {Imath::V3d(0.05, 0.05, 0.05)}}.curve(
            curve::CurveAngle::half));
    pearl = edit("pearl", {{"shape", "beckmann"}});
    expect_near(
        pearl.samples,
        curve::ShapedCurve{curve::CurveShape::beckmann, {Imath::V3d(0.05, 0.05, 0.05)}}.curve(
            curve::CurveAngle::half));
}

TEST_F(CurveEdits, PointsAndAShapeTakeEachOthersPlace) {
    const json points{{0, 5, 5, 5}, {0.5, 1, 2, 3}, {1, 0, 0, 0}};
    wire::MaterialEdit pearl = edit("pearl", {{"points", points}});
    EXPECT_FALSE(pearl.shape);
    const std::vector<curve::ControlPoint> expected{
        {0, {5, 5, 5}}, {0.5, {1, 2, 3}}, {1, {0, 0, 0}}};
    expect_near(pearl.samples, curve::curve_from_points(expected));
    pearl = edit("pearl", {{"shape", "velvet"}});
    EXPECT_FALSE(pearl.points);
    EXPECT_EQ(pearl.shape, curve::CurveShape::velvet);
}

TEST_F(CurveEdits, AStrokeChangesTheCurveAsItIsAndForgetsTheShape) {
    edit("pearl", {{"roughness", 0.3}});
    const curve::Curve before = curve_from_samples(state_.materials.at("pearl").samples);
    const wire::MaterialEdit pearl =
        edit("pearl",
             {{"stroke", {{"from", 0.25}, {"to", 0.5}, {"values", {{1, 2, 3}, {4, 4, 4}}}}}});
    EXPECT_FALSE(pearl.shape);
    expect_near(pearl.samples,
                curve::with_stroke(
                    before, {.from = 0.25, .to = 0.5, .values = {{1, 2, 3}, {4, 4, 4}}}));
}

TEST_F(CurveEdits, APresetLeavesItsShapeWhereItIsOne) {
    const wire::MaterialEdit post = edit("post", {{"preset", "gold"}});
    EXPECT_EQ(post.shape, curve::CurveShape::conductor);
    expect_near(post.samples, curve::preset_from_name("gold").curve());
    const wire::MaterialEdit pearl = edit("pearl", {{"preset", "pearl"}});
    expect_near(pearl.samples, curve::preset_from_name("pearl").curve());
}

TEST_F(CurveEdits, AStateThatIsHandedOverComesBackAsItWas) {
    edit("pearl", {{"roughness", 0.07}, {"tint", {1, 0.5, 0.25}}});
    edit("post", {{"preset", "silver"}});
    const json handed = to_json(state_).at("materials");
    wire::RoomState other;
    wire::apply_patch(other, with_samples({{"materials", handed}}, {}, curves_), {});
    EXPECT_EQ(other.materials, state_.materials);
    // Also where the room has edits of its own.
    wire::RoomState third;
    wire::apply_patch(
        third, with_samples({{"materials", {{"pearl", {{"preset", "satin"}}}}}}, {}, curves_),
        {});
    wire::apply_patch(third, with_samples({{"materials", handed}}, third.materials, curves_),
                      {});
    EXPECT_EQ(third.materials, state_.materials);
}

TEST_F(CurveEdits, NullTakesTheEditBack) {
    edit("pearl", {{"preset", "satin"}});
    wire::apply_patch(
        state_, with_samples({{"materials", {{"pearl", nullptr}}}}, state_.materials, curves_),
        {});
    EXPECT_TRUE(state_.materials.empty());
}

TEST_F(CurveEdits, SamplesThatAreNoCurveAreRefusedAndLoseNothing) {
    const wire::MaterialEdit before = edit("pearl", {{"roughness", 0.3}});
    const auto samples = [](std::size_t count, const json& last) {
        json list(count, json{1, 1, 1});
        list.back() = last;
        return json{{"samples", list}};
    };
    const json one{1, 1, 1};
    for (const json& bad :
         {samples(255, one), samples(257, one), samples(256, {1, 1, -1e-3}),
          samples(256, {1e30, 1, 1}), samples(256, {1, 1.001 * curve::kMostCurveValue, 1}),
          samples(256, {1, nullptr, 1}), samples(256, {1, 1, "1"}), samples(256, {1, 1}),
          samples(256, nullptr), samples(256, 1), json{{"samples", nullptr}},
          json{{"samples", json::array()}}, json{{"samples", 1}}}) {
        const json patch{{"materials", {{"pearl", bad}}}};
        try {
            wire::apply_patch(state_, with_samples(patch, state_.materials, curves_), {});
            ADD_FAILURE() << "taken: " << bad.dump();
        } catch (const wire::WireError& error) {
            EXPECT_EQ(std::string(error.path()).rfind("/materials/pearl/samples", 0), 0U)
                << error.path();
        }
        EXPECT_EQ(state_.materials.at("pearl"), before);
    }
    // Zeros, jumps and the highest value there is are curves.
    json jagged = json::array();
    for (int k = 0; k < 256; ++k) {
        const float value = k % 2 == 0 ? 0 : curve::kMostCurveValue;
        jagged.push_back({value, value, value});
    }
    EXPECT_EQ(edit("pearl", {{"samples", jagged}}).samples.numbers[3],
              double{curve::kMostCurveValue});
    edit("pearl", {{"samples", std::vector<std::vector<double>>(256, {0, 0, 0})}});
}

TEST_F(CurveEdits, WhatCannotBeIsRefusedByItsPath) {
    EXPECT_EQ(refusal({{"perl", {{"tint", {1, 1, 1}}}}}),
              "/materials/perl found perl expected one of the materials; did you mean pearl?");
    EXPECT_EQ(
        refusal({{"post", {{"preset", "gld"}}}}),
        "/materials/post/preset found gld expected one of the presets; did you mean gold?");
    EXPECT_EQ(refusal({{"pearl", {{"preset", "satin"}, {"shape", "ggx"}}}}),
              "/materials/pearl found preset and shape expected one or the other");
    EXPECT_NE(refusal({{"pearl",
                        {{"stroke", {{"from", 0.5}, {"to", 0.2}, {"values", {{1, 1, 1}}}}}}}}),
              "taken");
    EXPECT_EQ(refusal({{"pearl", {{"stroke", {{"from", 0}, {"to", 1}}}}}}).substr(0, 24),
              "/materials/pearl/stroke/");
    EXPECT_NE(refusal({{"pearl", {{"points", {{0.5, 1, 1, 1}, {0.5, 2, 2, 2}}}}}}), "taken");
    EXPECT_NE(refusal({{"pearl", {{"roughness", 1.5}}}}), "taken");  // GGX's α is at most 1
    EXPECT_NE(refusal({{"pearl", 7}}), "taken");
}

}  // namespace
}  // namespace relume::net
