#include "protocol/curve/curve_json.h"

#include "protocol/curve/curve_preset.h"
#include "tests/unit/curve/directions.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <random>
#include <vector>

namespace relume::curve {
namespace {

using Imath::V3d;
using Imath::V3f;
using nlohmann::json;

Curve random_curve(unsigned seed, bool is_grey) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-30, 6);
    return curve_from_function([&](double) {
        const auto value = [&] { return std::pow(10, exponent(random)); };
        return is_grey ? V3d(value()) : V3d(value(), value(), value());
    });
}

// Through the text, as a file has it.
json through_text(const json& value) {
    return json::parse(value.dump());
}

TEST(CurveJson, SamplesKeepTheirBits) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        for (const bool is_grey : {false, true}) {
            const Curve curve = random_curve(seed, is_grey);
            const json written = json_from_curve(curve);
            EXPECT_EQ(written.size(), 256U);
            EXPECT_EQ(written[0].is_number(), is_grey);
            EXPECT_EQ(curve_from_json(through_text(written), "c"), curve);
        }
    }
    EXPECT_EQ(json_from_curve(constant_curve(V3f(0.1F)))[7].dump(), "0.1");
}

TEST(CurveJson, ShapesComeBack) {
    for (const CurvePreset& preset : curve_presets()) {
        for (const PresetPart& part : preset.parts) {
            const json written = json_from_shaped_curve(part.shape);
            EXPECT_EQ(shaped_curve_from_json(through_text(written), "s"), part.shape);
        }
    }
    const json gold = json_from_shaped_curve(preset_from_name("gold").parts[0].shape);
    EXPECT_EQ(gold, json::parse(R"({"shape": "conductor", "n": [0.21, 0.43, 1.38],
                                    "e": [3.272, 2.455, 1.914]})"));
}

TEST(CurveJson, BrdfsComeBack) {
    std::vector<CurveBrdf> brdfs{
        CurveBrdf::ggx({0.9F, 0.6F, 0.3F}, 1, 0.09F),
        CurveBrdf::cook_torrance(0.3F, {0.2F, 0.5F, 1.4F}, V3f(3.9F)),
        CurveBrdf::ashikhmin_shirley(V3f(0.1F), 20, 150),
        CurveBrdf::phong({0.5F, 0.4F, 0.3F}, 40),
        CurveBrdf::measured({{CurveAngle::viewing, random_curve(3, false)},
                             {CurveAngle::half, random_curve(1, true)}}),
    };
    for (const CurveBrdf& brdf : brdfs) {
        const json written = json_from_curve_brdf(brdf);
        EXPECT_EQ(written.contains("curves"), brdf.model() == CurveModel::measured);
        EXPECT_EQ(curve_brdf_from_json(through_text(written), "b"), brdf);
        // One curve edited: it alone has samples.
        const CurveBrdf edited = brdf.with_curve(0, random_curve(9, false));
        const json of_edited = json_from_curve_brdf(edited);
        EXPECT_EQ(of_edited["curves"].size(), brdf.model() == CurveModel::measured ? 2U : 1U);
        EXPECT_EQ(curve_brdf_from_json(through_text(of_edited), "b"), edited);
    }
}

TEST(CurveJson, RefusesBadSamples) {
    const auto read = [](json value) {
        return [value] { static_cast<void>(curve_from_json(value, "edit.samples")); };
    };
    const json good = json_from_curve(constant_curve(V3f(1)));
    for (const std::size_t count : {0U, 255U, 257U}) {
        expect_curve_error(read(json(std::vector<double>(count, 1.0))),
                           "edit.samples: found " + std::to_string(count) + " samples");
    }
    const auto with = [&](json sample) {
        json value = good;
        value[12] = std::move(sample);
        return value;
    };
    expect_curve_error(read(with(-1)), "edit.samples[12]: found -1");
    expect_curve_error(read(with(1e30)), "found 1e+30");
    expect_curve_error(read(with(1e300)), "found 1e+300");
    expect_curve_error(read(with(std::numeric_limits<double>::quiet_NaN())), "found nan");
    expect_curve_error(read(with(nullptr)), "found null");
    expect_curve_error(read(with("1")), "found \"1\"");
    expect_curve_error(read(with({1, 2})), "[12]");
    expect_curve_error(read(with({1, 2, "x"})), "a number");
    expect_curve_error(read(with({1, -2, 3})), "found -2");
    expect_curve_error(read(json::object()), "an array of 256 samples");
}

TEST(CurveJson, RefusesBadShapesAndBrdfs) {
    const auto shape = [](const char* text) {
        return [text] { static_cast<void>(shaped_curve_from_json(json::parse(text), "p")); };
    };
    expect_curve_error(shape(R"({"shape": "gxx", "alpha": 0.1})"), "did you mean ggx");
    expect_curve_error(shape(R"({"shape": "ggx", "alpha": 2})"), "found 2 for alpha");
    expect_curve_error(shape(R"({"shape": "ggx", "alpha": [1, 1, 1]})"), "p.alpha");
    expect_curve_error(shape(R"({"shape": "ggx"})"), "no key alpha");
    expect_curve_error(shape(R"({"shape": "ggx", "alpha": 0.1, "alhpa": 1})"),
                       "did you mean alpha");
    expect_curve_error(shape(R"({"shape": 3})"), "p.shape: found 3");
    expect_curve_error(shape(R"([])"), "an object");
    expect_curve_error(shape(R"({"shape": "conductor", "n": [1, 2], "e": 1})"),
                       "a number or [red, green, blue]");
    const auto brdf = [](const char* text) {
        return [text] { static_cast<void>(curve_brdf_from_json(json::parse(text), "p")); };
    };
    expect_curve_error(brdf(R"({"model": "phon", "ks": 1, "exponent": 5})"),
                       "did you mean phong");
    expect_curve_error(brdf(R"({"model": "measured"})"), "no key curves");
    expect_curve_error(brdf(R"({"model": "measured", "curves": {}})"), "found 0 curves");
    expect_curve_error(brdf(R"({"model": "measured", "curves": {"fresnell": []}})"),
                       "did you mean fresnel");
    expect_curve_error(brdf(R"({"model": "measured", "curves": {"fresnel": [1]}})"),
                       "p.curves.fresnel: found 1 samples");
    expect_curve_error(brdf(R"({"model": "phong", "ks": 1, "exponent": -5})"), "for exponent");
    json other = json_from_curve_brdf(CurveBrdf::phong(V3f(1), 5));
    other["curves"]["distribution"] = json_from_curve(constant_curve(V3f(1)));
    expect_curve_error([&] { static_cast<void>(curve_brdf_from_json(other, "p")); },
                       "curve of phong: found distribution");
}

}  // namespace
}  // namespace relume::curve
