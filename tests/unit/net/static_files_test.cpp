#include "server/net/http/static_files.h"

#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <fstream>

namespace relume::net {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

class StaticFilesTest : public testing::Test {
  protected:
    void SetUp() override {
        write(root() / "index.html", "<title>page</title>");
        write(root() / "assets/app-1a2b.js", "run()");
        write(root() / "look.css", "body{}");
        write(scratch_.path() / "secret.txt", "secret");
    }
    [[nodiscard]] fs::path root() const { return scratch_.path() / "root"; }

    test::ScratchDirectory scratch_;
};

TEST_F(StaticFilesTest, ServesFilesWithTheirTypes) {
    const StaticFiles files(root());
    const StaticFile* const script = files.find("/assets/app-1a2b.js");
    ASSERT_NE(script, nullptr);
    EXPECT_EQ(*script->body, "run()");
    EXPECT_EQ(script->content_type, "text/javascript; charset=utf-8");
    EXPECT_NE(script->cache_control.find("immutable"), std::string::npos);
    const StaticFile* const index = files.find("/index.html");
    ASSERT_NE(index, nullptr);
    EXPECT_EQ(index->content_type, "text/html; charset=utf-8");
    EXPECT_EQ(index->cache_control, "no-cache");
    EXPECT_NE(index->entity_tag, script->entity_tag);
}

TEST_F(StaticFilesTest, PlacesWithinThePageGetTheIndexAndMissingFilesDoNot) {
    const StaticFiles files(root());
    EXPECT_EQ(files.find("/some/place"), files.find("/index.html"));
    EXPECT_EQ(files.find("/missing.js"), nullptr);
    EXPECT_EQ(files.find("/assets/app-1a2b.js.map"), nullptr);
}

TEST_F(StaticFilesTest, NothingOutsideIsReachable) {
    fs::create_symlink(scratch_.path() / "secret.txt", root() / "link.txt");
    fs::create_directory_symlink(scratch_.path(), root() / "up");
    const StaticFiles files(root());
    for (const char* const path :
         {"/../secret.txt", "/assets/../../secret.txt", "//secret.txt", "/link.txt",
          "/up/secret.txt", "secret.txt", "/./secret.txt", "/..\\secret.txt"}) {
        EXPECT_EQ(files.find(path), nullptr) << path;
    }
}

TEST_F(StaticFilesTest, AFolderWithoutAPageIsRefused) {
    fs::remove(root() / "index.html");
    try {
        const StaticFiles files(root());
        FAIL() << "took a folder without index.html";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("index.html"), std::string::npos);
    }
}

TEST(StaticFiles, WithoutAPageSaysHowToGetOne) {
    const StaticFiles files;
    const StaticFile* const index = files.find("/index.html");
    ASSERT_NE(index, nullptr);
    EXPECT_EQ(index->content_type, "text/plain; charset=utf-8");
    EXPECT_NE(index->body->find("--web-root"), std::string::npos);
}

}  // namespace
}  // namespace relume::net
