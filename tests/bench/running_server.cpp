#include "tests/bench/running_server.h"

#include "protocol/base/timing/stopwatch.h"
#include "tests/bench/programs.h"
#include "tests/support/timing.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace relume::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSceneName = "scene";
constexpr std::chrono::milliseconds kPoll{20};

}  // namespace

RunningServer::RunningServer(const fs::path& scene) {
    const fs::path scenes = folder_.path() / "scenes";
    fs::create_directory(scenes);
    fs::create_directory_symlink(fs::absolute(scene),
                                 scenes / fmt::format("{}.relume", kSceneName));
    // Bounds that would end the search for the number of sessions before the machine does.
    server_ = std::make_unique<test::Program>(
        server_program(),
        std::vector<std::string>{"--scenes", scenes.string(), "--listen", "127.0.0.1:0",
                                 "--port-file", (folder_.path() / "port").string(),
                                 "--max-rooms", "1024", "--max-rooms-per-address", "1024",
                                 "--max-connections", "4096", "--max-connections-per-address",
                                 "4096", "--log-level", "warn"},
        folder_.path(), "server");
    wait_until_ready();
}

RunningServer::~RunningServer() {
    server_->send(SIGTERM);
    server_->wait();
}

void RunningServer::wait_until_ready() {
    const fs::path port_file = folder_.path() / "port";
    const auto expect_running = [&] {
        if (!server_->is_running()) {
            throw std::runtime_error("relume-server ended: " + server_->errors());
        }
        std::this_thread::sleep_for(kPoll);
    };
    while (!fs::exists(port_file)) {
        expect_running();
    }
    std::string port;
    std::ifstream(port_file) >> port;
    url_ = "http://127.0.0.1:" + port;
    const auto is_ready = [&] {
        test::Program info(client_program(), {"info", "--json", "--server", url_},
                           folder_.path(), "info");
        return info.wait() == 0 && nlohmann::json::parse(info.output()).value("ready", false);
    };
    while (!is_ready()) {
        expect_running();
    }
}

std::vector<std::string> RunningServer::load_arguments(const Load& load) const {
    return {"load",
            "--server",
            url_,
            "--scene",
            kSceneName,
            "--sessions",
            std::to_string(load.dragging),
            "--idle",
            std::to_string(load.idle),
            "--rate",
            fmt::format("{}", load.rate_hz),
            "--seconds",
            fmt::format("{}", load.seconds)};
}

nlohmann::json RunningServer::run_load(const Load& load) const {
    return nlohmann::json::parse(
        test::run_to_end(client_program(), load_arguments(load), folder_.path(), "load"));
}

std::unique_ptr<test::Program> RunningServer::start_load(const Load& load) const {
    return std::make_unique<test::Program>(client_program(), load_arguments(load),
                                           folder_.path(), "standing-load");
}

double RunningServer::cpu_seconds() const {
    clockid_t clock = 0;
    if (const int error = ::clock_getcpuclockid(server_->id(), &clock); error != 0) {
        throw std::system_error(error, std::generic_category(), "clock_getcpuclockid");
    }
    timespec time{};
    if (::clock_gettime(clock, &time) != 0) {
        throw std::system_error(errno, std::generic_category(), "clock_gettime");
    }
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void RunningServer::wait_until_quiet(double timeout_seconds) const {
    constexpr double kQuiet = 0.01;
    const timing::Stopwatch waiting;
    double before = cpu_seconds();
    while (true) {
        std::this_thread::sleep_for(std::chrono::seconds(1));
        const double now = cpu_seconds();
        if (now - before < kQuiet) {
            return;
        }
        if (waiting.seconds() > timeout_seconds) {
            throw std::runtime_error(
                fmt::format("the server still uses {:.2f} cores after {:.0f} "
                            "s, expected it to be quiet",
                            now - before, waiting.seconds()));
        }
        before = now;
    }
}

}  // namespace relume::bench
