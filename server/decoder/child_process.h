// A program run on some bytes, its output read within limits of time. Internal to
// protocol/light.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace relume::decoder {

class FileDescriptor {
  public:
    explicit FileDescriptor(int fd = -1) : fd_(fd) {}
    ~FileDescriptor() { reset(); }
    FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.release()) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        reset();
        fd_ = other.release();
        return *this;
    }
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;

    [[nodiscard]] int get() const { return fd_; }
    void reset();

  private:
    int release();

    int fd_;
};

// How long a child is waited for: at most so long, and not after a stop is asked for.
struct ChildPatience {
    std::chrono::milliseconds timeout{0};
    std::stop_token stop;
};

// The child inherits its three standard descriptors and nothing else: `input` as a file, a pipe
// back, and /dev/null for errors; no environment, no blocked signals.
class ChildProcess {
  public:
    // Throws std::system_error when the program cannot be started.
    ChildProcess(const std::filesystem::path& program,
                 const std::vector<std::string>& arguments,
                 std::span<const std::byte> input,
                 const ChildPatience& patience);
    // Kills the child if it still runs, and collects it.
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ChildProcess(ChildProcess&&) = delete;
    ChildProcess& operator=(ChildProcess&&) = delete;

    enum class Read { complete, ended, timed_out, stopped };
    // Fills `into` from the child's output, as long as patience lasts.
    [[nodiscard]] Read read(std::span<std::byte> into);

    // For a child whose output has ended: waits for it, within the timeout, and says how it
    // ended: "exited with status 3", "was ended by signal 11 (Segmentation fault)"; empty for
    // success.
    [[nodiscard]] std::string wait();

  private:
    [[nodiscard]] int remaining_ms() const;

    std::chrono::steady_clock::time_point deadline_;
    std::stop_token stop_;
    FileDescriptor output_;
    pid_t pid_ = -1;
};

}  // namespace relume::decoder
