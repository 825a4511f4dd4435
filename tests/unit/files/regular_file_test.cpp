#include "protocol/base/files/regular_file.h"

#include "protocol/base/files/error.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstring>
#include <fstream>
#include <limits>

namespace relume::files {
namespace {

class RegularFile : public testing::Test {
  protected:
    [[nodiscard]] std::string refusal(const std::filesystem::path& path,
                                      Links links = Links::follow) const {
        try {
            static_cast<void>(read_regular_file(path, 100, links));
            return "none";
        } catch (const FileError& error) {
            return error.what();
        }
    }

    test::ScratchDirectory scratch_;
    std::filesystem::path path_ = scratch_.path() / "it";
};

TEST_F(RegularFile, IsReadWhole) {
    std::ofstream(path_) << "some bytes";
    EXPECT_EQ(read_regular_file(path_, 10), "some bytes");
    EXPECT_THROW(static_cast<void>(read_regular_file(path_, 9)), FileError);
    // No bound at all.
    EXPECT_EQ(read_regular_file(path_, std::numeric_limits<std::size_t>::max()), "some bytes");
}

// With no writer at its other end, opening a pipe waits for ever: the test would not end.
TEST_F(RegularFile, NothingElseIsOpenedAndNothingIsWaitedFor) {
    std::ofstream(scratch_.path() / "It.txt");
    EXPECT_EQ(refusal(scratch_.path() / "it.txt"),
              (scratch_.path() / "it.txt").string() +
                  ": no such file or folder; did you mean " +
                  (scratch_.path() / "It.txt").string() + "?");
    ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    EXPECT_EQ(refusal(path_), path_.string() + ": found a named pipe, expected a regular file");
    EXPECT_EQ(refusal(scratch_.path()),
              scratch_.path().string() + ": found a directory, expected a regular file");
    EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: found a device, expected a regular file");

    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string socket_path = (scratch_.path() / "s").string();
    ASSERT_LT(socket_path.size(), sizeof(address.sun_path));
    std::strcpy(address.sun_path, socket_path.c_str());
    const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM, 0));
    ASSERT_EQ(
        ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(refusal(socket_path), socket_path + ": found a socket, expected a regular file");
}

TEST_F(RegularFile, ItsBeginningIsReadAndNoMore) {
    const std::string text(std::size_t{200} << 10, 'x');
    std::ofstream(path_) << text;
    EXPECT_EQ(read_beginning(path_, 0), "");
    EXPECT_EQ(read_beginning(path_, 5), "xxxxx");
    EXPECT_EQ(read_beginning(path_, std::size_t{100} << 10), text.substr(0, 100 << 10));
    EXPECT_EQ(read_beginning(path_, std::size_t{1} << 20), text);
    EXPECT_EQ(read_regular_file(path_, text.size()), text);
    EXPECT_THROW(static_cast<void>(read_regular_file(path_, text.size() - 1)), FileError);
}

TEST_F(RegularFile, LinksAreFollowedOnlyWhereAsked) {
    std::ofstream(path_) << "x";
    const auto link = scratch_.path() / "link";
    std::filesystem::create_symlink(path_, link);
    EXPECT_EQ(refusal(link), "none");
    EXPECT_NE(refusal(link, Links::refuse).find("a symbolic link"), std::string::npos);
}

}  // namespace
}  // namespace relume::files
