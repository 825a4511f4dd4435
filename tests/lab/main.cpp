// relume-lab: speed against accuracy on any scene, light and sequence.
#include "protocol/transport/transport.h"
#include "server/light/environment_import.h"
#include "tests/lab/error_chart.h"
#include "tests/lab/experiment.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <numeric>

namespace {

using namespace relume;

struct RunOptions {
    std::string transport;
    std::string environment;
    std::string sequence = "slow-fast-slow";
    std::vector<std::string> methods{"nwa-30", "nwa-60", "nwa-100",
                                     "bi-30",  "pbi-30", "pbi-30-transport"};
    std::string output = "lab";
    std::uint64_t seed = 1;
};

void add_run_command(CLI::App& app, RunOptions& options) {
    CLI::App* run = app.add_subcommand("run", "run methods over one lighting sequence");
    run->add_option("--transport", options.transport, "transport directory")->required();
    run->add_option("--environment", options.environment, "HDR map")->required();
    run->add_option("--sequence", options.sequence, "what the light does")
        ->check(CLI::IsMember(lab::sequence_names()));
    run->add_option(
           "--methods", options.methods,
           "METHOD-BUDGET[-PRIORITY], separated by commas; a budget in coefficients (30) or "
           "bytes (400kB)")
        ->delimiter(',');
    run->add_option("--seed", options.seed, "seed of random sequences");
    run->add_option("-o,--output", options.output,
                    "folder for records.csv, error.svg, error.png");
}

// For people: means while the light moves, and what is left some images after it rests.
void print_summary(const std::vector<lab::Method>& methods,
                   const lab::LightingSequence& sequence,
                   const std::vector<lab::Record>& records) {
    constexpr std::uint32_t kSoon = 5;
    constexpr std::uint32_t kLater = 25;
    fmt::print("{:<26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "method", "L2 moving",
               "H1 moving", "rest +5", "rest +25", "last", "kB/image", "us/image");
    for (const lab::Method& method : methods) {
        double l2 = 0;
        double h1 = 0;
        double bytes = 0;
        double microseconds = 0;
        double soon = 0;
        double later = 0;
        double last = 0;
        for (const lab::Record& record : records) {
            if (record.method != method.label()) {
                continue;
            }
            if (record.image < sequence.rests_from) {
                l2 += record.error.l2;
                h1 += record.error.h1;
                bytes += static_cast<double>(record.bytes_touched);
                microseconds += record.microseconds;
            }
            soon = record.image == sequence.rests_from + kSoon ? record.error.l2 : soon;
            later = record.image == sequence.rests_from + kLater ? record.error.l2 : later;
            last = record.error.l2;
        }
        const double count = sequence.rests_from;
        fmt::print("{:<26} {:>9.4f} {:>9.4f} {:>9.2e} {:>9.2e} {:>9.2e} {:>9.0f} {:>8.0f}\n",
                   method.label(), l2 / count, h1 / count, soon, later, last,
                   bytes / count / 1000, microseconds / count);
    }
}

void run(const RunOptions& options) {
    const auto scene =
        std::make_shared<const engine::Scene>(transport::Transport::open(options.transport));
    auto imported = light::import_environment(options.environment);
    const auto environment = std::make_shared<const light::PrefilteredEnvironment>(
        std::make_shared<const light::EnvironmentMap>(std::move(imported.map)),
        scene->face_resolution());
    const lab::LightingSequence sequence = lab::make_sequence(
        options.sequence, {.environment = environment, .seed = options.seed});
    std::vector<lab::Method> methods;
    for (const std::string& text : options.methods) {
        methods.push_back(lab::method_from_text(text));
    }
    const auto records =
        lab::run_experiment(scene, sequence, methods, [&](std::uint32_t image) {
            fmt::print(stderr, "\rimage {} of {}", image + 1, sequence.images);
        });
    fmt::print(stderr, "\n");
    const std::filesystem::path output(options.output);
    std::filesystem::create_directories(output);
    lab::write_csv(output / "records.csv", records);
    const std::string title =
        fmt::format("{}, {}, {}", std::filesystem::path(options.transport).stem().string(),
                    std::filesystem::path(options.environment).stem().string(), sequence.name);
    lab::draw_error_chart(output / "error", title, records);
    print_summary(methods, sequence, records);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Charts speed against accuracy of relighting methods.", "relume-lab");
    app.require_subcommand(1);
    RunOptions options;
    add_run_command(app, options);
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "relume-lab: {}\n", error.what());
        return 1;
    }
    return 0;
}
