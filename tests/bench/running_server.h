// relume-server as it is delivered, serving one scene on the loopback.
#pragma once

#include "tests/support/program.h"
#include "tests/support/scratch_directory.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace relume::bench {

// Ended with this object.
class RunningServer {
  public:
    // Returns when the server is ready. Throws std::runtime_error when it ends instead.
    explicit RunningServer(const std::filesystem::path& scene);
    RunningServer(const RunningServer&) = delete;
    RunningServer& operator=(const RunningServer&) = delete;
    RunningServer(RunningServer&&) = delete;
    RunningServer& operator=(RunningServer&&) = delete;
    ~RunningServer();

    struct Load {
        std::size_t dragging = 0;
        std::size_t idle = 0;
        double rate_hz = 30;
        double seconds = 10;
    };
    // `relume load`, to its end; the object it prints. Throws std::runtime_error when a session
    // was refused or ended early.
    [[nodiscard]] nlohmann::json run_load(const Load& load) const;
    // The same, beside what follows; ended when the result goes away.
    [[nodiscard]] std::unique_ptr<test::Program> start_load(const Load& load) const;

    // What the server has used so far.
    [[nodiscard]] double cpu_seconds() const;
    // Returns when the server has used less than a hundredth of a core for a second. Throws
    // std::runtime_error when that takes longer than `timeout_seconds`.
    void wait_until_quiet(double timeout_seconds) const;

  private:
    [[nodiscard]] std::vector<std::string> load_arguments(const Load& load) const;
    void wait_until_ready();

    test::ScratchDirectory folder_;
    std::unique_ptr<test::Program> server_;
    std::string url_;
};

}  // namespace relume::bench
