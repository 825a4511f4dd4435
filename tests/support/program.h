// Programs of the project as processes.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace relume::test {

// A process that is running; killed with this object if it still is.
class Program {
  public:
    // Standard output and error go to files in `folder`, named after `name`. Throws
    // std::system_error when the program cannot be started.
    Program(const std::filesystem::path& program,
            const std::vector<std::string>& arguments,
            const std::filesystem::path& folder,
            const std::string& name);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;
    Program(Program&&) = delete;
    Program& operator=(Program&&) = delete;

    // Of the process, while it runs.
    [[nodiscard]] pid_t id() const { return process_; }
    void send(int signal) const;
    // The exit code, or 128 + the signal that ended it.
    int wait();
    [[nodiscard]] bool is_running();

    [[nodiscard]] std::string output() const;
    [[nodiscard]] std::string errors() const;

  private:
    std::filesystem::path output_;
    std::filesystem::path errors_;
    pid_t process_ = -1;
    int exit_code_ = -1;
};

// Waits for its end and returns its standard output. What it writes is kept in `folder` under
// `name`. Throws std::runtime_error with its standard error when it fails.
std::string run_to_end(const std::filesystem::path& program,
                       const std::vector<std::string>& arguments,
                       const std::filesystem::path& folder,
                       const std::string& name);

}  // namespace relume::test
