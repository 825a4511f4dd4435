#include "client/cli/curve_drag.h"

#include "protocol/curve/curve_shape.h"
#include "protocol/curve/stroke.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace relume::cli {
namespace {

using nlohmann::json;

wire::EditableMaterial material(const std::string& id, double alpha) {
    const curve::Curve baked = curve::curve_from_shape(
        curve::CurveShape::ggx, curve::CurveAngle::half, std::array{Imath::V3d(alpha)});
    wire::EditableMaterial made;
    made.id = id;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        for (const auto& channel : baked.rgb) {
            made.baked.samples.numbers.push_back(double{channel[k]});
        }
    }
    return made;
}

curve::Stroke stroke_of(const json& patch, const std::string& id) {
    const json& stroke = patch.at("materials").at(id).at("stroke");
    curve::Stroke read{.from = stroke.at("from"), .to = stroke.at("to"), .values = {}};
    for (const json& rgb : stroke.at("values")) {
        read.values.emplace_back(rgb[0].get<double>(), rgb[1].get<double>(),
                                 rgb[2].get<double>());
    }
    return read;
}

TEST(CurveDrag, DrawsStrokesThatACurveTakesFromLeftToRight) {
    CurveDrag drag({material("pearl", 0.1), material("post", 0.4)}, 3);
    std::set<std::string> drawn;
    for (int stroke = 0; stroke < 20; ++stroke) {
        double from = -1;
        double to = -1;
        for (std::uint32_t edit = 0; edit < CurveDrag::kEditsPerStroke; ++edit) {
            const json patch = drag.next();
            ASSERT_EQ(patch.at("materials").size(), 1U);
            const std::string id = patch.at("materials").begin().key();
            drawn.insert(id);
            const curve::Stroke read = stroke_of(patch, id);
            EXPECT_NO_THROW(static_cast<void>(curve::with_stroke({}, read)));
            if (edit > 0) {
                EXPECT_EQ(read.from, from);
                EXPECT_GE(read.to, to);
            }
            from = read.from;
            to = read.to;
        }
        EXPECT_GT(to, from);
    }
    EXPECT_EQ(drawn.size(), 2U);
}

TEST(CurveDrag, StaysNearTheCurveAsBaked) {
    const wire::EditableMaterial pearl = material("pearl", 0.05);
    CurveDrag drag({pearl}, 8);
    for (int i = 0; i < 400; ++i) {
        const curve::Stroke stroke = stroke_of(drag.next(), "pearl");
        const auto first = static_cast<std::size_t>(std::lround(stroke.from * 255));
        for (std::size_t k = 0; k < stroke.values.size(); ++k) {
            const double baked = pearl.baked.samples.numbers[3 * (first + k)];
            EXPECT_LE(stroke.values[k].x, baked * 4.001);
            EXPECT_GE(stroke.values[k].x, baked / 4.001);
        }
    }
}

// An edit that changes nothing is answered by no image, and would be timed until the next one.
TEST(CurveDrag, EveryEditChangesTheCurve) {
    const wire::EditableMaterial pearl = material("pearl", 0.1);
    CurveDrag drag({pearl}, 4);
    curve::Curve before;
    for (std::size_t k = 0; k < curve::kCurveSamples; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            before.rgb[c][k] = static_cast<float>(pearl.baked.samples.numbers[3 * k + c]);
        }
    }
    for (int i = 0; i < 400; ++i) {
        const curve::Curve after = curve::with_stroke(before, stroke_of(drag.next(), "pearl"));
        EXPECT_NE(after, before) << i;
        before = after;
    }
}

TEST(CurveDrag, TheSameSeedDrawsTheSame) {
    CurveDrag a({material("pearl", 0.1)}, 5);
    CurveDrag b({material("pearl", 0.1)}, 5);
    CurveDrag c({material("pearl", 0.1)}, 6);
    bool differs = false;
    for (int i = 0; i < 50; ++i) {
        const json drawn = a.next();
        EXPECT_EQ(drawn, b.next());
        differs = differs || drawn != c.next();
    }
    EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace relume::cli
