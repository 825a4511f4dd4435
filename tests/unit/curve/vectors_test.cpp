// protocol/curve/vectors: what every implementation has to compute.
#include "protocol/basis/daubechies4.h"
#include "protocol/curve/control_points.h"
#include "protocol/curve/curve_json.h"
#include "protocol/curve/curve_preset.h"
#include "protocol/curve/stroke.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace relume::curve {
namespace {

using Imath::V3d;
using nlohmann::json;

const json& vectors() {
    static const json read = [] {
        std::ifstream stream(std::string(RELUME_CURVE_VECTORS) + "/curves.json");
        return json::parse(stream);
    }();
    return read;
}

V3d vector_from(const json& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

std::vector<V3d> vectors_from(const json& values) {
    std::vector<V3d> all;
    for (const json& value : values) {
        all.push_back(vector_from(value));
    }
    return all;
}

CurveAngle angle_of(const json& vector) {
    return *kCurveAngleNames.value(vector.at("angle").get<std::string>());
}

Curve shaped(const json& vector) {
    return shaped_curve_from_json(vector.at("shape"), "shape").curve(angle_of(vector));
}

void expect_samples(const Curve& curve, const json& vector) {
    ASSERT_GE(vector.at("samples").size(), 5U);
    for (const auto& item : vector.at("samples").items()) {
        const std::size_t k = std::stoul(item.key());
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = item.value().at(c).get<double>();
            EXPECT_NEAR(static_cast<double>(curve.rgb[c].at(k)), expected,
                        1e-6 * std::fabs(expected) + 1e-30)
                << vector.dump().substr(0, 120) << " sample " << k;
        }
    }
}

TEST(CurveVectors, ShapesAndPresets) {
    for (const json& vector : vectors().at("shapes")) {
        expect_samples(shaped(vector), vector);
    }
    for (const json& vector : vectors().at("presets")) {
        expect_samples(preset_from_name(vector.at("name").get<std::string>()).curve(), vector);
    }
    EXPECT_EQ(vectors().at("presets").size(), curve_presets().size());
}

TEST(CurveVectors, ControlPoints) {
    for (const json& vector : vectors().at("points")) {
        std::vector<ControlPoint> points;
        for (const json& p : vector.at("points")) {
            points.push_back(
                {p.at(0).get<double>(),
                 {p.at(1).get<double>(), p.at(2).get<double>(), p.at(3).get<double>()}});
        }
        const auto scale = kValueScaleNames.value(vector.at("scale").get<std::string>());
        expect_samples(curve_from_points(points, *scale), vector);
    }
}

TEST(CurveVectors, Strokes) {
    for (const json& vector : vectors().at("strokes")) {
        const json& stroke = vector.at("stroke");
        expect_samples(with_stroke(shaped(vector), {stroke.at("from").get<double>(),
                                                    stroke.at("to").get<double>(),
                                                    stroke.at("softness").get<double>(),
                                                    vectors_from(stroke.at("values"))}),
                       vector);
    }
}

TEST(CurveVectors, Coefficients) {
    for (const json& vector : vectors().at("coefficients")) {
        const Curve curve = shaped(vector);
        for (std::size_t c = 0; c < 3; ++c) {
            std::array<float, kCurveSamples> coefficients{};
            basis::daubechies4_forward(curve.rgb[c], coefficients);
            const float largest = *std::max_element(coefficients.begin(), coefficients.end());
            for (const auto& item : vector.at("coefficients").items()) {
                EXPECT_NEAR(coefficients.at(std::stoul(item.key())),
                            item.value().at(c).get<float>(), 1e-6F * largest)
                    << item.key();
            }
        }
    }
}

TEST(CurveVectors, WhatIsReflected) {
    for (const json& vector : vectors().at("reflected")) {
        const CurveBrdf brdf = curve_brdf_from_json(vector.at("brdf"), "brdf");
        const V3d expected = vector_from(vector.at("value"));
        const V3d value(brdf.evaluate(Imath::V3f(vector_from(vector.at("wi"))),
                                      Imath::V3f(vector_from(vector.at("wo")))));
        EXPECT_NEAR((value - expected).length(), 0,
                    2e-5 * std::max({expected.x, expected.y, expected.z}))
            << vector.dump();
    }
}

}  // namespace
}  // namespace relume::curve
