// Where a bake writes, what it says at its end, and how it ends.
#include "precompute/bake/commands.h"
#include "precompute/bake/output_directory.h"
#include "precompute/bake/progress_line.h"
#include "precompute/bake/verdict.h"
#include "protocol/base/files/directory_lock.h"
#include "protocol/base/program/program.h"
#include "tests/support/scratch_directory.h"

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <fstream>
#include <string>
#include <vector>

namespace relume::bake {
namespace {

namespace fs = std::filesystem;

class Output : public testing::Test {
  protected:
    // The exit code of `relume-bake words…`, as the program gives it.
    int run(const std::vector<std::string>& words) {
        std::vector<const char*> argv{"relume-bake"};
        for (const std::string& word : words) {
            argv.push_back(word.c_str());
        }
        CLI::App app("test", "relume-bake");
        Arguments arguments;
        add_arguments(app, arguments);
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
        const int code = program::run_program(app, static_cast<int>(argv.size()), argv.data(),
                                              [&] { return run_command(app, arguments); });
        output_ = testing::internal::GetCapturedStdout();
        errors_ = testing::internal::GetCapturedStderr();
        return code;
    }
    // Of a scene that bakes in no time.
    int bake_to(const std::string& output) {
        return run({"--builtin", "plane", "-o", output, "--size", "20x18", "--light-resolution",
                    "4", "--bounces", "0"});
    }
    [[nodiscard]] std::string file(const std::string& name) const {
        return (scratch_.path() / name).string();
    }
    [[nodiscard]] bool says(const std::string& words) const {
        return (errors_ + output_).find(words) != std::string::npos;
    }

    test::ScratchDirectory scratch_;
    std::string output_;
    std::string errors_;
};

TEST_F(Output, ANameIsCompletedOrRefusedBeforeTheBake) {
    EXPECT_EQ(transport_directory_from_option("a/mine"), "a/mine.relume");
    EXPECT_EQ(transport_directory_from_option("mine.relume"), "mine.relume");
    EXPECT_EQ(transport_directory_from_option("mine.relume/"), "mine.relume");
    EXPECT_EQ(transport_directory_from_option("v1.2.relume"), "v1.2.relume");
    fs::create_directory(scratch_.path() / "folder");
    for (const std::string& wrong :
         {std::string("mine.exr"), std::string("mine.RELUME"), std::string("."),
          std::string(".."), std::string("/"), std::string(".relume"),
          std::string("m\u00fcde.relume"), std::string("two words"),
          std::string(65, 'a') + ".relume", std::string(".hidden.relume"), file("folder"),
          file("folder") + "/"}) {
        EXPECT_THROW(static_cast<void>(transport_directory_from_option(wrong)),
                     program::UsageError)
            << wrong;
    }
}

TEST_F(Output, ACompletedNameIsSaidAndServable) {
    ASSERT_EQ(bake_to(file("mine")), 0) << errors_;
    EXPECT_TRUE(says("completed to " + file("mine.relume"))) << errors_;
    EXPECT_TRUE(fs::exists(file("mine.relume/manifest.json")));
    EXPECT_EQ(bake_to(file("mine.exr")), 2);
    EXPECT_TRUE(says("expected NAME.relume")) << errors_;
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch_.path()), {}), 1);
}

TEST_F(Output, EndsWithWhatItIsGoodForAndTheNextCommand) {
    ASSERT_EQ(bake_to(file("mine.relume")), 0) << errors_;
    EXPECT_TRUE(says("good for light of any kind")) << output_;
    EXPECT_TRUE(says("direct light alone")) << output_;
    EXPECT_TRUE(says("error of storing it: ")) << output_;
    EXPECT_TRUE(says("exact images are exact for the light as filtered onto")) << output_;
    EXPECT_TRUE(says(" % of the image under a natural map")) << output_;
    EXPECT_TRUE(says("relume-server --scenes " + scratch_.path().string())) << output_;
    EXPECT_TRUE(says("relume render --scene mine ")) << output_;
    EXPECT_TRUE(says(file("mine.relume/view/picture.png"))) << output_;
    EXPECT_GT(fs::file_size(file("mine.relume/view/picture.png")), 100U);
}

TEST_F(Output, WhatIsMissingFromTheSceneStandsInTheReport) {
    std::ofstream(file("s.mtl")) << "newmtl wood\nKd 1 1 1\nmap_Kd oak.png\n";
    std::ofstream(file("s.obj")) << "mtllib s.mtl\nv -1 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\n"
                                    "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
    ASSERT_EQ(run({file("s.obj"), "-o", file("s.relume"), "--size", "8x8", "--light-resolution",
                   "4", "--bounces", "0", "--eye", "0,0.3,3", "--look-at", "0,0.3,0"}),
              0)
        << errors_;
    EXPECT_NE(output_.find("not used of the scene"), std::string::npos) << output_;
    EXPECT_NE(output_.find("oak.png"), std::string::npos) << output_;
}

TEST_F(Output, ASecondBakeIntoOneDirectoryIsRefusedAtItsStart) {
    fs::create_directory(file("mine.relume"));
    {
        const files::DirectoryLock first(file("mine.relume"));
        EXPECT_EQ(bake_to(file("mine.relume")), 1);
        EXPECT_TRUE(says("another process")) << errors_;
    }
    EXPECT_EQ(bake_to(file("mine.relume")), 0) << errors_;
}

TEST_F(Output, WhatWouldFailAtTheEndFailsAtTheStart) {
    std::ofstream(file("plain.relume")) << "a file";
    EXPECT_EQ(bake_to(file("plain.relume")), 1);
    EXPECT_TRUE(says("cannot create the folder")) << errors_;
    EXPECT_EQ(bake_to("/proc/mine.relume"), 1);
    for (const char* name : {"manifest.json", "sketch.bin", "view/picture.png",
                             "shards/00000.shard", "report.json"}) {
        fs::create_directories(fs::path(file("mine.relume")) / name);
        EXPECT_EQ(bake_to(file("mine.relume")), 1) << name;
        EXPECT_TRUE(says(std::string(name) + ": found a directory")) << errors_;
        fs::remove_all(file("mine.relume"));
    }
    std::ofstream(file("view.relume"));
    fs::remove(file("view.relume"));
    fs::create_directory(file("view.relume"));
    std::ofstream(file("view.relume/view")) << "in the way";
    EXPECT_EQ(bake_to(file("view.relume")), 1);
    EXPECT_TRUE(says("view: cannot create the folder")) << errors_;
}

TEST_F(Output, NeverMoreThanIsLeastIsAskedOfTheDisk) {
    ASSERT_EQ(bake_to(file("mine.relume")), 0) << errors_;
    BakeParameters parameters;
    parameters.width = 20;
    parameters.height = 18;
    parameters.face_resolution = 4;
    std::uint64_t written = 0;
    std::uint64_t longest = 0;
    for (const auto& entry : fs::recursive_directory_iterator(file("mine.relume"))) {
        if (entry.is_regular_file()) {
            written += entry.file_size();
            longest = std::max<std::uint64_t>(longest, entry.file_size());
        }
    }
    const LeastBytes least = least_bytes(parameters);
    EXPECT_LE(least.total, written);
    EXPECT_LE(least.longest_file, longest);
    EXPECT_GT(4 * least.total, written);
}

TEST_F(Output, WhatAnEarlierRunLeftIsInNobodysWay) {
    fs::create_directories(file("mine.relume/manifest.json.tmp/x"));
    fs::create_directories(file("mine.relume/shards/00000.shard.tmp"));
    std::ofstream(file("mine.relume/sketch.bin.tmp")) << "half";
    ASSERT_EQ(::mkfifo(file("mine.relume/columns.bin").c_str(), 0600), 0);
    fs::create_directories(file("mine.relume/partial"));
    ASSERT_EQ(::mkfifo(file("mine.relume/partial/00000.notes").c_str(), 0600), 0);
    EXPECT_EQ(bake_to(file("mine.relume")), 0) << errors_;
    EXPECT_EQ(run({"verify", file("mine.relume")}), 0) << errors_;
}

TEST_F(Output, TheLimitOnFileSizesIsAnErrorAndNoEnd) {
    rlimit before{};
    ::getrlimit(RLIMIT_FSIZE, &before);
    for (const rlim_t bytes : {rlim_t{4097}, rlim_t{12'000}}) {
        rlimit limit = before;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const int code = bake_to(file("mine.relume"));
        ::setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(code, 1) << bytes;
        EXPECT_TRUE(says("ulimit -f")) << errors_;
        EXPECT_FALSE(fs::exists(file("mine.relume")));
    }
    EXPECT_EQ(bake_to(file("mine.relume")), 0) << errors_;
}

TEST_F(Output, ASceneThatCannotBeReadLeavesNoTrace) {
    EXPECT_EQ(run({file("none.glb"), "-o", file("mine.relume")}), 1);
    EXPECT_FALSE(fs::exists(file("mine.relume")));
}

TEST_F(Output, WrongUsageEndsWithTwoAndFailureWithOne) {
    EXPECT_EQ(run({}), 2);
    EXPECT_EQ(run({"--builtin", "plane", "-o", file("x"), "--bits", "5"}), 2);
    EXPECT_EQ(run({"--builtin", "plane", "-o", file("x"), "--size", "640"}), 2);
    EXPECT_EQ(run({"--builtin", "plane", "-o", file("x"), "--sampels", "5"}), 2);
    EXPECT_TRUE(says("did you mean --samples?")) << errors_;
    EXPECT_EQ(run({"--builtin", "tabel", "-o", file("x")}), 2);
    EXPECT_TRUE(says("did you mean table?")) << errors_;
    EXPECT_EQ(run({"verify"}), 2);
    ASSERT_EQ(bake_to(file("mine.relume")), 0);
    EXPECT_EQ(run({"verify", file("mien.relume")}), 1);
    EXPECT_TRUE(says("did you mean " + file("mine.relume") + "?")) << errors_;
    EXPECT_EQ(run({"info", file("mine")}), 1);
    EXPECT_TRUE(says("did you mean " + file("mine.relume") + "?")) << errors_;
}

TEST_F(Output, AReportThatIsNoneIsNotTold) {
    ASSERT_EQ(bake_to(file("mine.relume")), 0);
    const std::string nested = std::string(200'000, '[');
    for (const std::string& report :
         {nested, std::string("{"), std::string("[]"), std::string(R"({"seconds": 3})"),
          std::string(R"({"seconds": {"total": "long"}})")}) {
        std::ofstream(file("mine.relume/report.json")) << report;
        EXPECT_EQ(run({"info", file("mine.relume")}), 0) << errors_;
        EXPECT_FALSE(says("baked in")) << output_;
        EXPECT_EQ(run({"info", file("mine.relume"), "--json"}), 0) << errors_;
        EXPECT_EQ(run({"verify", file("mine.relume")}), 0) << errors_;
    }
    fs::remove(file("mine.relume/report.json"));
    ASSERT_EQ(::mkfifo(file("mine.relume/report.json").c_str(), 0600), 0);
    EXPECT_EQ(run({"info", file("mine.relume")}), 0) << errors_;
}

TEST(ProgressText, NamesNoTimeLeftBeforeItMeansSomething) {
    BakeProgress progress{
        .receivers_done = 9, .receivers_resumed = 0, .receivers = 100, .rays = 0};
    EXPECT_EQ(progress_text(progress, 9).find("left"), std::string::npos);
    progress.receivers_done = 10;
    EXPECT_NE(progress_text(progress, 10).find("1:30 left"), std::string::npos);
    // Of a bake that goes on, what was there already says nothing about its speed.
    progress = {.receivers_done = 91, .receivers_resumed = 90, .receivers = 100, .rays = 0};
    EXPECT_NE(progress_text(progress, 1).find("0:09 left"), std::string::npos);
    progress.receivers_done = 90;
    EXPECT_EQ(progress_text(progress, 1).find("left"), std::string::npos);
}

TEST(PerCent, HasTwoDigitsThatCount) {
    EXPECT_EQ(per_cent(0), "0 %");
    EXPECT_EQ(per_cent(0.008), "0.80 %");
    EXPECT_EQ(per_cent(0.12345), "12 %");
    EXPECT_EQ(per_cent(0.028), "2.8 %");
    EXPECT_EQ(per_cent(0.00000271), "0.00027 %");
}

}  // namespace
}  // namespace relume::bake
