#include "protocol/base/files/disk_room.h"

#include "protocol/base/files/atomic_file.h"
#include "protocol/base/files/directory_lock.h"
#include "protocol/base/files/error.h"
#include "tests/support/scratch_directory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <string>

namespace relume::files {
namespace {

// The limit on file sizes for the time of its life.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    FileSizeLimit(FileSizeLimit&&) = delete;
    FileSizeLimit& operator=(FileSizeLimit&&) = delete;
    ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

  private:
    rlimit before_{};
};

TEST(DiskRoom, IsFoundOrMissedBeforeTheWork) {
    const test::ScratchDirectory scratch;
    EXPECT_NO_THROW(require_room(scratch.path(), 1, 1));
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
    EXPECT_THROW(require_room(scratch.path(), std::uint64_t{1} << 62, 1), FileError);
    EXPECT_THROW(require_room(scratch.path() / "missing", 1, 1), FileError);
    const FileSizeLimit limit(1 << 20);
    EXPECT_NO_THROW(require_room(scratch.path(), 1 << 20, 1 << 20));
    EXPECT_THROW(require_room(scratch.path(), (1 << 20) + 1, (1 << 20) + 1), FileError);
}

TEST(DiskRoom, AFolderInTheWayIsSeen) {
    const test::ScratchDirectory scratch;
    std::filesystem::create_directory(scratch.path() / "manifest.json");
    EXPECT_THROW(require_replaceable(scratch.path() / "manifest.json"), FileError);
    EXPECT_NO_THROW(require_replaceable(scratch.path() / "other"));
}

TEST(DiskRoom, TheLimitOnFileSizesIsAnErrorOfTheWrite) {
    const test::ScratchDirectory scratch;
    make_file_size_limit_an_error();
    const FileSizeLimit limit(1 << 16);
    const std::string text(1 << 17, 'x');
    try {
        write_file_atomically(scratch.path() / "long", {bytes_of(text)});
        FAIL() << "a file beyond the limit was written";
    } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find("File too large"), std::string::npos)
            << error.what();
    }
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(DirectoryLock, IsHeldByOneAndFreeAgainHoweverItsHolderEnds) {
    const test::ScratchDirectory scratch;
    {
        const DirectoryLock lock(scratch.path());
        EXPECT_THROW(DirectoryLock{scratch.path()}, FileError);
    }
    EXPECT_NO_THROW(DirectoryLock{scratch.path()});
    EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
    EXPECT_THROW(DirectoryLock{scratch.path() / "missing"}, FileError);

    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const DirectoryLock lock(scratch.path());
        [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
        ::pause();
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    EXPECT_THROW(DirectoryLock{scratch.path()}, FileError);
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_NO_THROW(DirectoryLock{scratch.path()});
    ::close(ready[0]);
    ::close(ready[1]);
}

}  // namespace
}  // namespace relume::files
