// relume-lab stability: every way in which methods fail, its bounds and what was measured.
#include "tests/lab/commands/commands.h"
#include "tests/lab/commands/interruption.h"
#include "tests/lab/commands/progress.h"
#include "tests/stability/failures.h"
#include "tests/stability/stability_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace relume::lab {
namespace {

using stability::Failure;
using stability::Result;

struct StabilityOptions {
    std::vector<std::string> only;
    bool thorough = false;
    bool json = false;
    std::uint64_t seed = 1;
    std::string cache = RELUME_STABILITY_CACHE;
    std::string output = "out/stability";
};

std::vector<Failure> chosen_failures(const StabilityOptions& options) {
    std::vector<Failure> chosen;
    for (const Failure& failure : stability::failures()) {
        if (options.only.empty() || std::find(options.only.begin(), options.only.end(),
                                              failure.name) != options.only.end()) {
            chosen.push_back(failure);
        }
    }
    return chosen;
}

std::vector<Result> run_failures(const StabilityOptions& options,
                                 const std::vector<Failure>& failures) {
    constexpr std::size_t kParts = 100;
    std::vector<Result> results;
    Progress progress("percent", failures.size() * kParts);
    stability::Workbench workbench(
        {.effort = options.thorough ? stability::Effort::thorough : stability::Effort::brief,
         .cache = options.cache,
         .seed = options.seed,
         .progress = [&](std::string_view what, double part) {
             progress.update(
                 results.size() * kParts + static_cast<std::size_t>(part * double{kParts}),
                 std::string(what));
         }});
    for (const Failure& failure : failures) {
        if (is_interrupted()) {
            break;
        }
        results.push_back({failure, failure.provoke(workbench)});
        if (!options.json) {
            fmt::print("{}", text_from(results.back()));
            std::fflush(stdout);
        }
    }
    return results;
}

int run(const StabilityOptions& options) {
    catch_interruption();
    const std::vector<Failure> failures = chosen_failures(options);
    const std::vector<Result> results = run_failures(options, failures);
    const bool complete = results.size() == failures.size();
    stability::write_report(options.output, results, complete);
    if (options.json) {
        fmt::print("{}\n", json_from(results).dump());
    }
    if (!complete) {
        fmt::print(stderr, "relume-lab: interrupted after {} of {} failures\n", results.size(),
                   failures.size());
        return kInterrupted;
    }
    const bool hold = std::all_of(results.begin(), results.end(),
                                  [](const Result& result) { return result.holds(); });
    return hold ? 0 : 1;
}

std::vector<std::string> failure_names() {
    std::vector<std::string> names;
    for (const Failure& failure : stability::failures()) {
        names.emplace_back(failure.name);
    }
    return names;
}

}  // namespace

Command add_stability_command(CLI::App& program) {
    auto options = std::make_shared<StabilityOptions>();
    CLI::App* command = program.add_subcommand(
        "stability",
        "provoke every failure and hold it to its bounds; exit code 1 if one breaks");
    command->add_flag("--long", options->thorough,
                      "10⁴ histories, 10⁶ edits: minutes instead of seconds");
    command->add_flag("--json", options->json, "findings as JSON on standard output");
    command->add_option("--only", options->only, "failures by name, separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(failure_names()));
    command->add_option("--seed", options->seed, "of all random choices")
        ->capture_default_str();
    command->add_option("--cache", options->cache, "where scenes are baked to and kept")
        ->capture_default_str();
    command
        ->add_option("-o,--output", options->output,
                     "folder for stability.json, pictures and report.html")
        ->capture_default_str();
    return {command, [options] { return run(*options); }};
}

}  // namespace relume::lab
