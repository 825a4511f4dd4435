// relume-bench: the figures of the engine and the server, measured in one run.
#include "protocol/base/program/program.h"
#include "tests/bench/figure.h"
#include "tests/bench/report.h"
#include "tests/bench/workbench.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

namespace {

using namespace relume::bench;

bool is_wanted(const FigureGroup& group, const std::vector<std::string>& only) {
    return only.empty() ||
           std::any_of(group.figures.begin(), group.figures.end(), [&](const Figure& figure) {
               return std::find(only.begin(), only.end(), figure.key) != only.end();
           });
}

std::vector<std::string> all_keys() {
    std::vector<std::string> keys;
    for (const FigureGroup& group : figure_groups()) {
        for (const Figure& figure : group.figures) {
            keys.push_back(figure.key);
        }
    }
    return keys;
}

void omit_group(const FigureGroup& group, const std::string& why, Results& results) {
    for (const Figure& figure : group.figures) {
        results.omit(figure.key, why);
    }
}

// A group that fails costs its own figures only; false when one did.
bool measure_all(Workbench& workbench, Results& results) {
    bool complete = true;
    for (const FigureGroup& group : figure_groups()) {
        if (!is_wanted(group, workbench.options().only)) {
            omit_group(group, "not asked for", results);
            continue;
        }
        fmt::print(stderr, "measuring {}\n", group.figures.front().key);
        try {
            group.measure(workbench, results);
        } catch (const std::exception& error) {
            fmt::print(stderr, "relume-bench: {}\n", error.what());
            omit_group(group, error.what(), results);
            complete = false;
        }
    }
    return complete;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Measures the engine and the server against the machine and their peers.",
                 "relume-bench");
    Options options;
    options.cache = RELUME_BENCH_CACHE;
    bool json = false;
    app.add_flag("--json", json, "one JSON object instead of a table");
    app.add_option("--only", options.only, "figures wanted, by key, separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(all_keys()));
    app.add_option("--scene", options.scene,
                   "transport directory instead of mesh100k, 512x512, 6x64x64")
        ->check(CLI::ExistingDirectory);
    app.add_option("--cache", options.cache, "where scenes are baked to and kept")
        ->capture_default_str();
    app.add_flag("--flagship", options.flagship,
                 "also 1920x1080 in colour with one bounce; bakes for long when it is missing");
    app.add_flag("--quick", options.quick, "everything small and once: no times to quote");
    return relume::program::run_program(app, argc, argv, [&] {
        Workbench workbench(options);
        Results results;
        const bool complete = measure_all(workbench, results);
        const std::string report =
            json ? json_report(workbench, results) : table_report(workbench, results);
        fmt::print("{}\n", report);
        return complete ? relume::program::kDone : relume::program::kFailed;
    });
}
