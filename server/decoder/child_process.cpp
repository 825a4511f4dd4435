#include "server/decoder/child_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <limits>
#include <system_error>
#include <thread>

namespace relume::decoder {
namespace {

void require(bool holds, int error, const char* what) {
    if (!holds) {
        throw std::system_error(error, std::generic_category(), what);
    }
}

// In memory and sealed, so that the child can neither change it nor make us wait for it to
// read.
FileDescriptor memory_file(std::span<const std::byte> bytes) {
    FileDescriptor file(memfd_create("relume-upload", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    require(file.get() >= 0, errno, "memfd_create");
    while (!bytes.empty()) {
        const ssize_t written = write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        require(written > 0, errno, "writing the upload to memory");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    require(fcntl(file.get(), F_ADD_SEALS,
                  F_SEAL_WRITE | F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0,
            errno, "sealing the upload");
    require(lseek(file.get(), 0, SEEK_SET) == 0, errno, "lseek");
    return file;
}

class SpawnSettings {
  public:
    SpawnSettings(int input, int output) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawnattr_init(&attributes_);
        const auto check = [](int error) {
            require(error == 0, error, "posix_spawn settings");
        };
        check(posix_spawn_file_actions_adddup2(&actions_, input, STDIN_FILENO));
        check(posix_spawn_file_actions_adddup2(&actions_, output, STDOUT_FILENO));
        check(posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY,
                                               0));
        // Other libraries' sockets are not all close-on-exec.
        check(posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1));
        sigset_t signals;
        sigemptyset(&signals);
        check(posix_spawnattr_setsigmask(&attributes_, &signals));
        sigfillset(&signals);
        check(posix_spawnattr_setsigdefault(&attributes_, &signals));
        // Ctrl-C is for the parent, which ends the child itself.
        check(posix_spawnattr_setpgroup(&attributes_, 0));
        check(posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK |
                                                         POSIX_SPAWN_SETSIGDEF |
                                                         POSIX_SPAWN_SETPGROUP));
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    SpawnSettings(SpawnSettings&&) = delete;
    SpawnSettings& operator=(SpawnSettings&&) = delete;

    [[nodiscard]] pid_t spawn(const std::filesystem::path& program,
                              const std::vector<std::string>& arguments) const {
        std::vector<std::string> words{program.string()};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        argv.reserve(words.size() + 1);
        std::transform(words.begin(), words.end(), std::back_inserter(argv),
                       [](std::string& word) { return word.data(); });
        argv.push_back(nullptr);
        char* no_environment[] = {nullptr};
        pid_t pid = -1;
        const int error = posix_spawn(&pid, program.c_str(), &actions_, &attributes_,
                                      argv.data(), static_cast<char**>(no_environment));
        require(error == 0, error, program.c_str());
        return pid;
    }

  private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

}  // namespace

void FileDescriptor::reset() {
    if (fd_ >= 0) {
        close(fd_);
        fd_ = -1;
    }
}

int FileDescriptor::release() {
    const int fd = fd_;
    fd_ = -1;
    return fd;
}

ChildProcess::ChildProcess(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           std::span<const std::byte> input,
                           const ChildPatience& patience)
    : deadline_(std::chrono::steady_clock::now() + patience.timeout), stop_(patience.stop) {
    const FileDescriptor file = memory_file(input);
    int ends[2] = {-1, -1};
    require(pipe2(static_cast<int*>(ends), O_CLOEXEC) == 0, errno, "pipe2");
    output_ = FileDescriptor(ends[0]);
    const FileDescriptor child_end(ends[1]);
    pid_ = SpawnSettings(file.get(), child_end.get()).spawn(program, arguments);
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

int ChildProcess::remaining_ms() const {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(
        deadline_ - std::chrono::steady_clock::now());
    return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(
        left.count(), 0, std::numeric_limits<int>::max()));
}

ChildProcess::Read ChildProcess::read(std::span<std::byte> into) {
    constexpr int kLooksForStopMs = 50;
    while (!into.empty()) {
        if (stop_.stop_requested()) {
            return Read::stopped;
        }
        pollfd waiting{output_.get(), POLLIN, 0};
        const int patience = remaining_ms();
        const int ready = poll(&waiting, 1, std::min(patience, kLooksForStopMs));
        if (ready < 0 && errno == EINTR) {
            continue;
        }
        require(ready >= 0, errno, "poll");
        if (ready == 0 && patience > kLooksForStopMs) {
            continue;
        }
        if (ready == 0) {
            return Read::timed_out;
        }
        const ssize_t count = ::read(output_.get(), into.data(), into.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        require(count >= 0, errno, "reading from the child");
        if (count == 0) {
            return Read::ended;
        }
        into = into.subspan(static_cast<std::size_t>(count));
        if (!into.empty() && remaining_ms() == 0) {
            return Read::timed_out;  // a trickle must not keep us for ever
        }
    }
    return Read::complete;
}

std::string ChildProcess::wait() {
    int status = 0;
    for (;;) {
        const pid_t ended = waitpid(pid_, &status, WNOHANG);
        if (ended == pid_) {
            break;
        }
        if (ended < 0 && errno != EINTR) {
            pid_ = -1;  // collected by somebody else's handler
            return "was collected elsewhere";
        }
        if (remaining_ms() == 0) {
            return "did not end";
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    pid_ = -1;
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        if (number == SIGSYS) {
            return "tried a forbidden system call";
        }
        if (number == SIGXCPU || number == SIGKILL) {
            return fmt::format("was ended by signal {} ({})", number,
                               "it used up its time or memory");
        }
        return fmt::format("was ended by signal {} ({})", number, strsignal(number));
    }
    return WEXITSTATUS(status) == 0 ? ""
                                    : fmt::format("exited with status {}", WEXITSTATUS(status));
}

}  // namespace relume::decoder
