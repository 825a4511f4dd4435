// The whole way: real server, real client, loopback, both on this machine's cores.
#include "tests/bench/figure_groups.h"
#include "protocol/base/timing/stopwatch.h"
#include "tests/bench/running_server.h"
#include "tests/bench/workbench.h"
#include "tests/support/timing.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

namespace relume::bench {
namespace {

constexpr double kLargestP99Ms = 100;
// Edits that no image answered, of all.
constexpr double kLargestLoss = 0.01;
constexpr double kQuietTimeoutSeconds = 300;

struct Sizes {
    double latency_seconds;
    double drag_seconds;
    double idle_seconds;
    std::size_t idle_sessions;
    std::size_t most_sessions;
};
constexpr Sizes kSizes{.latency_seconds = 15,
                       .drag_seconds = 6,
                       .idle_seconds = 5,
                       .idle_sessions = 200,
                       .most_sessions = 128};
constexpr Sizes kQuickSizes{.latency_seconds = 1,
                            .drag_seconds = 1,
                            .idle_seconds = 1,
                            .idle_sessions = 200,  // the bounds of the server, too
                            .most_sessions = 2};

void measure_latency(const RunningServer& server, const Sizes& sizes, Results& results) {
    const auto load = server.run_load(
        {.dragging = 1, .idle = 0, .rate_hz = 60, .seconds = sizes.latency_seconds});
    results.measured("edit_to_image") = load;
    results.set("edit_to_image_ms_p50", load.at("edit_to_image_ms_p50").get<double>());
    results.set("edit_to_image_ms_p99", load.at("edit_to_image_ms_p99").get<double>());
}

void measure_idle(const RunningServer& server, const Sizes& sizes, Results& results) {
    const auto watcher =
        server.start_load({.dragging = 0, .idle = 1, .rate_hz = 30, .seconds = 600});
    // For it to join at all; being quiet before would be no merit.
    std::this_thread::sleep_for(std::chrono::seconds(1));
    server.wait_until_quiet(kQuietTimeoutSeconds);
    const double before = server.cpu_seconds();
    const timing::Stopwatch stopwatch;
    std::this_thread::sleep_for(std::chrono::duration<double>(sizes.idle_seconds));
    const double used = server.cpu_seconds() - before;
    results.set("idle_cpu", used / stopwatch.seconds());
    results.measured("idle") = {{"cpu_seconds", used}, {"seconds", stopwatch.seconds()}};
}

// Whether so many sessions drag smoothly, and what was seen.
bool drags_smoothly(const RunningServer& server,
                    std::size_t sessions,
                    const Sizes& sizes,
                    nlohmann::json& runs) {
    const auto load = server.run_load(
        {.dragging = sessions, .idle = 0, .rate_hz = 30, .seconds = sizes.drag_seconds});
    const auto edits = load.at("edits").get<double>();
    const auto shown = load.at("edits_shown").get<double>();
    const auto p99 = load.at("edit_to_image_ms_p99");
    runs.push_back({{"sessions", sessions},
                    {"edit_to_image_ms_p50", load.at("edit_to_image_ms_p50")},
                    {"edit_to_image_ms_p99", p99},
                    {"images_per_second", load.at("images_per_second")},
                    {"stated_error_p50", load.at("stated_error_p50")}});
    return p99.is_number() && p99.get<double>() <= kLargestP99Ms &&
           shown >= (1 - kLargestLoss) * edits;
}

// The largest number that drags smoothly, to within a sixteenth.
void measure_sessions(const RunningServer& server, const Sizes& sizes, Results& results) {
    const auto watchers = server.start_load(
        {.dragging = 0, .idle = sizes.idle_sessions, .rate_hz = 30, .seconds = 3600});
    std::this_thread::sleep_for(std::chrono::seconds(1));
    server.wait_until_quiet(kQuietTimeoutSeconds);
    nlohmann::json runs = nlohmann::json::array();
    std::size_t good = 0;
    std::size_t bad = 1;
    while (bad <= sizes.most_sessions && drags_smoothly(server, bad, sizes, runs)) {
        good = bad;
        bad *= 2;
    }
    while (bad - good > std::max<std::size_t>(1, good / 16) && bad <= sizes.most_sessions) {
        const std::size_t middle = (good + bad) / 2;
        (drags_smoothly(server, middle, sizes, runs) ? good : bad) = middle;
    }
    results.set("sessions_at_30hz", static_cast<double>(good));
    results.measured("sessions") = {{"idle_sessions", sizes.idle_sessions}, {"runs", runs}};
}

void measure(Workbench& workbench, Results& results) {
    const Sizes& sizes = workbench.quick() ? kQuickSizes : kSizes;
    const RunningServer server(workbench.scene()->transport().directory());
    // Decodes and prefilters the environment, once per server.
    static_cast<void>(server.run_load({.dragging = 1, .idle = 0, .rate_hz = 30, .seconds = 1}));
    measure_latency(server, sizes, results);
    measure_idle(server, sizes, results);
    measure_sessions(server, sizes, results);
}

}  // namespace

FigureGroup served_figures() {
    return {.figures = {{.key = "edit_to_image_ms_p50",
                         .meaning = "edit to image at the client, one drag at 60 Hz, ms",
                         .aim = Aim::at_most,
                         .target = 8},
                        {.key = "edit_to_image_ms_p99",
                         .meaning = "edit to image at the client, one drag at 60 Hz, ms",
                         .aim = Aim::at_most,
                         .target = 20},
                        {.key = "sessions_at_30hz",
                         .meaning = "sessions dragging at 30 Hz with p99 <= 100 ms, 200 idle",
                         .aim = Aim::at_least,
                         .target = 16},
                        {.key = "idle_cpu",
                         .meaning = "cores the server uses for an idle, exact session",
                         .aim = Aim::at_most,
                         .target = 0.001}},
            .measure = measure};
}

}  // namespace relume::bench
