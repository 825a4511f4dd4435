// relume-server: serves relit scenes over HTTP and WebSockets until SIGTERM or SIGINT; SIGHUP
// makes it look for new scenes and environments.
#include "protocol/base/files/disk_room.h"
#include "server/net/base/log_sink.h"
#include "server/net/configuration.h"
#include "server/net/server.h"

#include <spdlog/spdlog.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <span>

namespace {

void set_up_log(const std::string& level) {
    auto logger = std::make_shared<spdlog::logger>("relume-server",
                                                   relume::net::make_log_sink(STDERR_FILENO));
    logger->set_pattern("time=%Y-%m-%dT%H:%M:%S.%e%z level=%l event=%v");
    logger->set_level(spdlog::level::from_str(level));
    spdlog::set_default_logger(std::move(logger));
}

// Blocked in all threads, so that one can wait for them; a peer that is gone is an error of its
// write, not of the process.
sigset_t block_signals() {
    std::signal(SIGPIPE, SIG_IGN);
    relume::files::make_file_size_limit_an_error();
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    return signals;
}

int serve(const relume::net::Configuration& configuration) {
    const sigset_t signals = block_signals();
    relume::net::Server server(configuration);
    int signal = 0;
    while (sigwait(&signals, &signal) != 0 || signal == SIGHUP) {
        server.reload();
    }
    spdlog::info("signal number={}", signal);
    server.drain();
    if (server.is_opening_scenes()) {
        // Nobody will see it, and it may take minutes: it is left half way.
        spdlog::shutdown();
        std::quick_exit(0);
    }
    return 0;
}

// What still waits to be logged goes before the end.
class LogUntilTheEnd {
  public:
    LogUntilTheEnd() = default;
    LogUntilTheEnd(const LogUntilTheEnd&) = delete;
    LogUntilTheEnd& operator=(const LogUntilTheEnd&) = delete;
    ~LogUntilTheEnd() { spdlog::shutdown(); }
};

}  // namespace

int main(int argc, char** argv) {
    const LogUntilTheEnd log;
    try {
        const relume::net::CommandLine line = relume::net::parse_command_line(
            std::span<const char* const>(argv, static_cast<std::size_t>(argc)));
        const relume::net::Configuration& configuration = line.configuration;
        set_up_log(configuration.log_level);
        std::optional<tbb::global_control> threads;
        if (configuration.threads > 0) {
            threads.emplace(tbb::global_control::max_allowed_parallelism,
                            configuration.threads);
        }
        if (line.request == relume::net::Request::check_configuration) {
            relume::net::check_configuration(configuration);
            std::puts("the configuration is sound");
            return 0;
        }
        return serve(configuration);
    } catch (const relume::net::CommandLineExit& exit) {
        std::fputs(exit.what(), exit.code() == 0 ? stdout : stderr);
        return exit.code();
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "relume-server: %s\n", failure.what());
        return 1;
    }
}
