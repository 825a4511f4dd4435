#include "protocol/base/program/program.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <gtest/gtest.h>

#include <vector>

namespace relume::program {
namespace {

class Usage : public testing::Test {
  protected:
    // The exit code of `thing words…`; standard error goes to `errors_`.
    int run(
        std::vector<const char*> words, const std::function<int()>& work = [] { return 0; }) {
        CLI::App app("A test.", "thing");
        int samples = 0;
        app.add_option("--samples", samples);
        app.add_subcommand("verify");
        words.insert(words.begin(), "thing");
        testing::internal::CaptureStderr();
        testing::internal::CaptureStdout();
        const int code = run_program(app, static_cast<int>(words.size()), words.data(), work);
        output_ = testing::internal::GetCapturedStdout();
        errors_ = testing::internal::GetCapturedStderr();
        return code;
    }

    std::string output_;
    std::string errors_;
};

TEST_F(Usage, EndsLikeEveryProgram) {
    EXPECT_EQ(run({}), 0);
    EXPECT_EQ(errors_, "");
    EXPECT_EQ(run({"--help"}), 0);
    EXPECT_NE(output_.find("--samples"), std::string::npos);
    EXPECT_EQ(run({}, [] { return 7; }), 7);
    EXPECT_EQ(run({"--samples", "many"}), 2);
    EXPECT_EQ(errors_.find("thing: "), 0U) << errors_;
    EXPECT_EQ(run({}, []() -> int { throw UsageError("found a, expected b"); }), 2);
    EXPECT_EQ(errors_, "thing: found a, expected b\n");
    EXPECT_EQ(run({}, []() -> int { throw std::runtime_error("no luck"); }), 1);
    EXPECT_EQ(errors_, "thing: no luck\n");
}

TEST_F(Usage, NamesWhatMayHaveBeenMeant) {
    EXPECT_EQ(run({"--sampels", "3"}), 2);
    EXPECT_NE(errors_.find("did you mean --samples?"), std::string::npos) << errors_;
    EXPECT_EQ(run({"--sampels=3"}), 2);
    EXPECT_NE(errors_.find("did you mean --samples?"), std::string::npos) << errors_;
    EXPECT_EQ(run({"verfiy"}), 2);
    EXPECT_NE(errors_.find("did you mean verify?"), std::string::npos) << errors_;
    EXPECT_EQ(run({"--nothing-like-it"}), 2);
    EXPECT_EQ(errors_.find("did you mean"), std::string::npos) << errors_;
}

}  // namespace
}  // namespace relume::program
