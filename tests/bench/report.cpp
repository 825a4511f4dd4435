#include "tests/bench/report.h"

#include "server/engine/kernels/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <thread>

namespace relume::bench {
namespace {

// As the system calls it; empty where it does not say.
std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const std::size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
            return line.substr(colon + 2);
        }
    }
    return {};
}

nlohmann::json context_of(Workbench& workbench, const Results& results) {
    nlohmann::json context = {{"cpu", processor_name()},
                              {"target", engine::target_name()},
                              {"threads", std::thread::hardware_concurrency()},
                              {"quick", workbench.quick()},
                              {"why_null", results.omissions()},
                              {"measured", results.measured()}};
    for (const int threads : Workbench::thread_counts()) {
        context[fmt::format("read_gb_per_s_{}t", threads)] =
            workbench.read_bandwidth().bytes_per_second(threads) / 1e9;
    }
    if (const auto scene = workbench.scene_in_use()) {
        context["scene"] = scene->transport().directory().filename().string();
        context["transport_bytes"] = scene->transport().total_bytes();
    }
    return context;
}

std::string target_text(const Figure& figure) {
    switch (figure.aim) {
        case Aim::at_least:
            return fmt::format(">= {:g}", figure.target);
        case Aim::at_most:
            return fmt::format("<= {:g}", figure.target);
        case Aim::reported:
            return "-";
    }
    return {};
}

std::string line_of(const Figure& figure, const Results& results) {
    const auto value = results.value(figure.key);
    if (!value) {
        const auto why = results.omissions().find(figure.key);
        return fmt::format("{:<36} {:>10} {:>9}  {:<7} {}\n", figure.key, "-",
                           target_text(figure), "-",
                           why == results.omissions().end() ? "" : why->second);
    }
    const char* verdict = figure.aim == Aim::reported ? "-"
                          : figure.reached(*value)    ? "met"
                                                      : "missed";
    return fmt::format("{:<36} {:>10.4g} {:>9}  {:<7} {}\n", figure.key, *value,
                       target_text(figure), verdict, figure.meaning);
}

}  // namespace

std::string json_report(Workbench& workbench, const Results& results) {
    nlohmann::json report = nlohmann::json::object();
    for (const FigureGroup& group : figure_groups()) {
        for (const Figure& figure : group.figures) {
            const auto value = results.value(figure.key);
            report[figure.key] = value ? nlohmann::json(*value) : nlohmann::json();
        }
    }
    report["context"] = context_of(workbench, results);
    return report.dump();
}

std::string table_report(Workbench& workbench, const Results& results) {
    const nlohmann::json context = context_of(workbench, results);
    std::string table = fmt::format("{}, {} threads, kernels {}\n{}: {:.0f} MB of transport\n",
                                    context.at("cpu").dump(), context.at("threads").dump(),
                                    context.at("target").dump(), context.at("scene").dump(),
                                    context.at("transport_bytes").get<double>() / 1e6);
    for (const int threads : Workbench::thread_counts()) {
        table += fmt::format(
            "memory is read at {:.1f} GB/s by {} thread(s)\n",
            context.at(fmt::format("read_gb_per_s_{}t", threads)).get<double>(), threads);
    }
    table += fmt::format("\n{:<36} {:>10} {:>9}  {:<7} {}\n", "figure", "value", "target", "",
                         "what it is");
    for (const FigureGroup& group : figure_groups()) {
        for (const Figure& figure : group.figures) {
            table += line_of(figure, results);
        }
    }
    return table;
}

}  // namespace relume::bench
