#include "precompute/bake/commands.h"
#include "precompute/bake/image_file.h"
#include "protocol/base/program/program.h"
#include "protocol/base/program/usage.h"
#include "tests/support/scratch_directory.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

class Command : public testing::Test {
  protected:
    // The exit status of `relume-bake words…`; what was thrown goes to `fault_`.
    int run(std::vector<std::string> words) {
        CLI::App app("test", "relume-bake");
        Arguments arguments;
        add_arguments(app, arguments);
        fault_.clear();
        std::reverse(words.begin(), words.end());
        try {
            app.parse(words);
            return run_command(app, arguments);
        } catch (const program::UsageError& error) {
            fault_ = error.what();
            return program::kWrongUsage;
        } catch (const std::exception& error) {
            fault_ = error.what();
            return 1;
        }
    }
    void expect_fault(const std::vector<std::string>& words, const std::string& named) {
        EXPECT_NE(run(words), 0) << named;
        EXPECT_NE(fault_.find(named), std::string::npos) << fault_ << " / " << named;
    }
    [[nodiscard]] std::string file(const std::string& name) const {
        return (scratch_.path() / name).string();
    }

    test::ScratchDirectory scratch_;
    std::string fault_;
};

TEST_F(Command, BakesABuiltinSceneAndLooksAtIt) {
    const std::string out = file("plane.relume");
    ASSERT_EQ(run({"--builtin", "plane", "-o", out, "--size", "20x18", "--light-resolution",
                   "4", "--bounces", "0"}),
              0)
        << fault_;
    EXPECT_EQ(run({"info", out}), 0) << fault_;
    EXPECT_EQ(run({"info", out, "--json"}), 0) << fault_;
    EXPECT_EQ(run({"verify", out}), 0) << fault_;
    EXPECT_EQ(run({"list"}), 0) << fault_;
    EXPECT_TRUE(std::filesystem::exists(out + "/report.json"));

    write_exr(file("light.exr"), {24, 4, 3, std::vector<float>(24 * 4 * 3, 1.0F)});
    EXPECT_EQ(run({"relight", out, "--light", file("light.exr"), "-o", file("out.exr")}), 0)
        << fault_;
    EXPECT_TRUE(std::filesystem::exists(file("out.exr")));

    std::filesystem::resize_file(out + "/sketch.bin", 10);
    EXPECT_EQ(run({"verify", out}), 1);
    expect_fault({"info", out}, "sketch.bin");
}

TEST_F(Command, NamesWhatIsWrongWithTheWords) {
    expect_fault({"-o", file("x")}, "scene file");
    expect_fault({"--builtin", "plane"}, "-o");
    expect_fault({"--builtin", "castle", "-o", file("x")}, "castle");
    expect_fault({file("missing.glb"), "-o", file("x")}, "missing.glb");
    expect_fault({"--builtin", "plane", "a.obj", "-o", file("x")}, "builtin");
    const std::vector<std::string> bake{"--builtin", "plane", "-o", file("x")};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), bake.begin(), bake.end());
        return more;
    };
    expect_fault(with({"--size", "640"}), "--size is '640'");
    expect_fault(with({"--size", "640x480x3"}), "--size");
    expect_fault(with({"--size", "0x480"}), "width is 0");
    expect_fault(with({"--size", "-4x480"}), "--size");
    expect_fault(with({"--eye", "1,2"}), "--eye is '1,2'");
    expect_fault(with({"--eye", "1,2,up"}), "--eye");
    expect_fault(with({"--eye", "0,0,0", "--look-at", "0,0,0"}), "eye");
    expect_fault(with({"--fov", "190"}), "190");
    expect_fault(with({"--fov", "wide"}), "wide");
    expect_fault(with({"--bits", "5"}), "bits is 5");
    expect_fault(with({"--light-resolution", "48"}), "light resolution is 48");
    expect_fault(with({"--samples", "0"}), "samples is 0");
    expect_fault(with({"--bounces", "-1"}), "-1");
    expect_fault(with({"--no-such-flag"}), "no-such-flag");
    EXPECT_FALSE(std::filesystem::exists(file("x") + "/manifest.json"));
}

// Words that no scene could make right, whatever is wrong with them.
TEST_F(Command, WrongWordsEndWithTwo) {
    const std::vector<std::vector<std::string>> wrong{
        {"--builtin", "castle"},
        {"--builtin", "plane", "--eye", "nan,0,0"},
        {"--builtin", "plane", "--look-at", "0,0,inf"},
        {"--builtin", "plane", "--up", "0,-inf,0"},
        {"--builtin", "plane", "--eye", "1e999,0,0"},
        {"--builtin", "plane", "--fov", "nan"},
        {"--builtin", "plane", "--fov", "inf"},
        {"--builtin", "plane", "--fov", "180"},
        {"--builtin", "plane", "--shrinkage", "nan"},
        {"--builtin", "plane", "--samples", "1048577"},
        {"--builtin", "plane", "--samples", "1048576", "--size", "4096x4096"},
        {"--builtin", "plane", "--order", "5"},
        {"--builtin", "plane", "--order", "5", "--basis", "haar"},
        {"--builtin", "plane", "--order", "21", "--basis", "sh"},
    };
    for (std::vector<std::string> words : wrong) {
        words.insert(words.end(), {"-o", file("wrong")});
        EXPECT_EQ(run(words), program::kWrongUsage) << words[1] << " " << words[2] << fault_;
    }
    EXPECT_FALSE(std::filesystem::exists(file("wrong.relume") + "/manifest.json"));
}

TEST_F(Command, RefusesLightsThatDoNotFit) {
    const std::string out = file("plane.relume");
    ASSERT_EQ(run({"--builtin", "plane", "-o", out, "--size", "4x4", "--light-resolution", "4",
                   "--bounces", "0"}),
              0)
        << fault_;
    const auto relit = [&](const std::string& light) {
        return std::vector<std::string>{"relight", out, "--light", light, "-o", file("o.exr")};
    };
    expect_fault(relit(file("none.exr")), "none.exr");
    write_exr(file("map.exr"), {8, 4, 3, std::vector<float>(8 * 4 * 3, 1.0F)});
    expect_fault(relit(file("map.exr")), "expected a cubemap strip of 24×4");
    write_exr(file("grey.exr"), {24, 4, 1, std::vector<float>(24 * 4, 1.0F)});
    expect_fault(relit(file("grey.exr")), "1 channels");
    write_exr(file("nan.exr"), {24, 4, 3, std::vector<float>(24 * 4 * 3, std::nanf(""))});
    expect_fault(relit(file("nan.exr")), "not finite");
    std::ofstream(file("junk.exr")) << "no image";
    expect_fault(relit(file("junk.exr")), "junk.exr");
}

TEST_F(Command, BakesAMaterialAndLooksAtIt) {
    const std::string out = file("satin.material");
    const std::vector<std::string> words{"material", "satin", "--model", "phong:exponent=8",
                                         "-n",       "8",     "-o",      out};
    ASSERT_EQ(run(words), 0) << fault_;
    EXPECT_EQ(run({"info", out}), 0) << fault_;
    EXPECT_EQ(run({"info", out, "--json"}), 0) << fault_;
    EXPECT_EQ(run({"verify", out}), 0) << fault_;

    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return more;
    };
    expect_fault(with({"--energy", "0"}), "fraction of energy is 0");
    expect_fault(with({"--reflections", "66"}), "66 nodes");
    expect_fault(with({"--texel-samples", "9"}), "samples along a texel are 9");
    expect_fault(with({"--most-mib", "0"}), "most-mib");
    expect_fault({"material", "a/b", "--model", "lambert"}, "the material's name is 'a/b'");
    expect_fault({"material", "a", "--model", "lambert", "-o", file("a.png")}, "NAME.material");
    expect_fault({"material", "a", "--model", "lambert", "-n", "48", "-o", out},
                 "face resolution is 48");
    expect_fault({"material", "a", "--model", "lambert", "-o", file("none/a.material")},
                 "none");
    expect_fault({"material", "a", "--model", "ggx:roughness=0.05", "--most-mib", "1", "-n",
                  "16", "--normals", "9", "--reflections", "33", "-o", out},
                 "--most-mib");
    EXPECT_EQ(run({"verify", out}), 0) << "what was refused changed the file: " << fault_;

    std::filesystem::resize_file(out, std::filesystem::file_size(out) - 1);
    expect_fault({"verify", out}, "satin.material: length");
    expect_fault({"info", out}, "satin.material: length");
}

TEST_F(Command, BakesMaterialsThatAreEditedUnderAnyLight) {
    const std::vector<std::string> words{"--builtin", "earrings",   "-o",
                                         file("e"),   "--size",     "20x18",
                                         "--bounces", "0",          "--light-resolution",
                                         "8",         "--editable", "pearl,cloth"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return more;
    };
    ASSERT_EQ(run(with({"--visibility-resolution", "4"})), 0) << fault_;
    EXPECT_EQ(run({"info", file("e.relume")}), 0) << fault_;
    EXPECT_EQ(run({"verify", file("e.relume")}), 0) << fault_;
    EXPECT_TRUE(std::filesystem::exists(file("e.relume") + "/points.bin"));
    expect_fault(with({"--visibility-resolution", "16"}), "the light's 8");
    expect_fault(with({"--editable", "perl"}), "did you mean pearl");
    expect_fault(with({"--edit", "pearl", "--environment", "sky-noon"}), "one of them");
    expect_fault(with({"--receivers", "vertices"}), "--receivers vertices");
    expect_fault(with({"--model", "pearl=ggx"}), "--model");
}

// Terms and curves are found in different ways, which one option names.
TEST_F(Command, NamesTheWaysToFactor) {
    const std::vector<std::string> terms{"--builtin", "plane", "-o", file("f.relume")};
    const std::vector<std::string> curves{
        "--builtin", "earrings", "-o",    file("f.relume"), "--edit",
        "pearl",     "--size",   "16x16", "--environment",  "sky-noon"};
    const auto with = [](std::vector<std::string> words, const std::string& method) {
        words.insert(words.end(), {"--factors", method});
        return words;
    };
    expect_fault(with(terms, "homomorphic"), "expected for terms one of svd, nmf");
    expect_fault(with(terms, "nfm"), "--factors is 'nfm'");
    expect_fault(with(curves, "svd"), "expected for curves one of homomorphic, nmf");
}

}  // namespace
}  // namespace relume::bake
