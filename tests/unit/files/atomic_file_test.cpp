#include "protocol/base/files/atomic_file.h"

#include "protocol/base/files/error.h"
#include "protocol/base/files/regular_file.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace relume::files {
namespace {

class AtomicFile : public testing::Test {
  protected:
    void write(const std::string& text) const {
        write_file_atomically(path_, {bytes_of(text)});
    }
    [[nodiscard]] std::string text() const { return read_regular_file(path_, 1 << 20); }

    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "it";
    std::filesystem::path temporary_ = scratch_.path() / "it.tmp";
};

TEST_F(AtomicFile, ReplacesTheOldOneAndLeavesNothingBeside) {
    write("old");
    write("new");
    EXPECT_EQ(text(), "new");
    EXPECT_FALSE(std::filesystem::exists(temporary_));
}

TEST_F(AtomicFile, WhatAnEarlierRunLeftIsInNobodysWay) {
    std::ofstream(temporary_) << "half a fi";
    std::filesystem::permissions(temporary_, std::filesystem::perms::owner_read);
    write("after a killed run");
    EXPECT_EQ(text(), "after a killed run");

    // A link is not written through.
    std::ofstream(scratch_.path() / "other") << "untouched";
    std::filesystem::create_symlink(scratch_.path() / "other", temporary_);
    write("beside a link");
    EXPECT_EQ(text(), "beside a link");
    EXPECT_EQ(read_regular_file(scratch_.path() / "other", 100), "untouched");

    std::filesystem::create_directories(temporary_ / "kept");
    write("beside a folder");
    EXPECT_EQ(text(), "beside a folder");
    EXPECT_TRUE(std::filesystem::exists(temporary_ / "kept"));
}

TEST_F(AtomicFile, WhatCannotBeWrittenLeavesTheOldOne) {
    std::filesystem::create_directory(path_);
    EXPECT_THROW(write("x"), FileError);
    EXPECT_TRUE(std::filesystem::is_directory(path_));
    EXPECT_FALSE(std::filesystem::exists(temporary_));
    const std::string text = "x";
    EXPECT_THROW(write_file_atomically(scratch_.path() / "no" / "folder", {bytes_of(text)}),
                 FileError);
}

}  // namespace
}  // namespace relume::files
