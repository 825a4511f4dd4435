#include "client/cli/material_options.h"

#include "client/cli/client_error.h"
#include "client/cli/edit_options.h"
#include "protocol/base/program/usage.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace relume::cli {
namespace {

using nlohmann::json;

std::string failure_of(const MaterialOptions& options) {
    try {
        static_cast<void>(materials_from_options(options));
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing was refused";
}

json ramp() {
    json samples = json::array();
    for (int k = 0; k < 256; ++k) {
        samples.push_back(k / 255.0);
    }
    return samples;
}

TEST(MaterialOptions, NothingAskedIsNoSection) {
    EXPECT_EQ(materials_from_options({}), json::object());
    EXPECT_FALSE(patch_from_options({}, "").contains("materials"));
}

TEST(MaterialOptions, ACurveIsSamplesOfAFileOrAnEditOfTheEntry) {
    const test::ScratchDirectory scratch;
    const std::string file = (scratch.path() / "curve.json").string();
    std::ofstream(file) << ramp().dump();
    const json materials = materials_from_options(
        {.curves = {"pearl=@" + file, R"(post={"shape":"ggx","roughness":0.1})"},
         .diffuses = {"cloth=0.2,1e-1,0"},
         .tints = {"post=1,0.8,0.3"}});
    ASSERT_EQ(materials["pearl"]["samples"].size(), 256U);
    EXPECT_EQ(materials["pearl"]["samples"][51], json({0.2, 0.2, 0.2}));
    EXPECT_EQ(materials["post"],
              json::parse(R"({"shape":"ggx","roughness":0.1,"tint":[1,0.8,0.3]})"));
    EXPECT_EQ(materials["cloth"], json::parse(R"({"diffuse":[0.2,0.1,0]})"));
}

TEST(MaterialOptions, SamplesOfThreeColoursStayAsTheyAre) {
    json samples = json::array();
    for (int k = 0; k < 256; ++k) {
        samples.push_back({k, 2, 3});
    }
    const json materials = materials_from_options(
        {.curves = {"pearl=" + samples.dump()}, .diffuses = {}, .tints = {}});
    EXPECT_EQ(materials["pearl"]["samples"], samples);
}

TEST(MaterialOptions, AreAppliedOverThePatch) {
    EditOptions options;
    options.patch = R"({"materials":{"pearl":{"tint":[2,2,2],"diffuse":[3,3,3]}}})";
    options.materials.diffuses = {"pearl=1,0,0"};
    EXPECT_EQ(patch_from_options(options, "").at("materials"),
              json::parse(R"({"pearl":{"tint":[2,2,2],"diffuse":[1,0,0]}})"));
}

TEST(MaterialOptions, WhatIsWrongIsNamed) {
    EXPECT_THROW(static_cast<void>(materials_from_options({.curves = {"pearl"}})),
                 program::UsageError);
    EXPECT_THROW(static_cast<void>(materials_from_options({.diffuses = {"pearl=1,2"}})),
                 program::UsageError);
    EXPECT_EQ(failure_of({.curves = {"=[]"}}),
              R"(--curve: found "=[]", expected MATERIAL=JSON or MATERIAL=@FILE)");
    EXPECT_EQ(failure_of({.tints = {"pearl=red"}}),
              R"(--tint: found "red", expected MATERIAL=R,G,B)");
    json samples = ramp();
    samples.erase(0);
    EXPECT_EQ(failure_of({.curves = {"pearl=" + samples.dump()}}),
              "--curve pearl: found 255 samples, expected 256");
    samples = ramp();
    samples[17] = {1, 2};
    EXPECT_EQ(failure_of({.curves = {"pearl=" + samples.dump()}}),
              "--curve pearl: sample 17: found an array of 2, expected a number or three for "
              "red, green and blue");
    EXPECT_EQ(failure_of({.curves = {"pearl=7"}}),
              "--curve pearl: found 7, expected 256 samples or an object");
    EXPECT_NE(failure_of({.curves = {"pearl={\"shape\":}"}}).find("column"), std::string::npos);
    EXPECT_NE(failure_of({.curves = {"pearl=@/nowhere.json"}}).find("/nowhere.json"),
              std::string::npos);
}

}  // namespace
}  // namespace relume::cli
