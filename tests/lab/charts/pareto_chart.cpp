#include "tests/lab/charts/pareto_chart.h"

#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relume::lab {
namespace {

constexpr double kLeastError = 1e-6;

std::vector<std::string> series_in(const std::vector<Summary>& summaries) {
    std::vector<std::string> series;
    for (const Summary& summary : summaries) {
        const std::string name = series_of(summary.method);
        if (std::find(series.begin(), series.end(), name) == series.end()) {
            series.push_back(name);
        }
    }
    return series;
}

// One data block of all series and the front, separated so that `index` tells them apart.
std::string panel_block(const std::string& name, const ParetoPanel& panel, ParetoCost cost) {
    std::string block = fmt::format("${} << EOD\n", name);
    for (const std::string& series : series_in(panel.summaries)) {
        for (const Summary& summary : panel.summaries) {
            if (series_of(summary.method) == series) {
                const CostAndError point = cost_and_error(summary, cost);
                block += fmt::format("{:.5g} {:.5g}\n", point.cost, point.error);
            }
        }
        block += "\n\n";
    }
    std::vector<CostAndError> points;
    for (const Summary& summary : panel.summaries) {
        points.push_back(cost_and_error(summary, cost));
    }
    for (const std::size_t i : pareto_front(points)) {
        block += fmt::format("{:.5g} {:.5g}\n", points[i].cost, points[i].error);
    }
    return block + "EOD\n";
}

std::string plot_command(const std::string& block,
                         const std::vector<std::string>& series,
                         double point_size,
                         bool titles) {
    std::string command =
        fmt::format("plot ${} index {} using 1:2 with steps lw 3 lc rgb '#c8c8c8' {}", block,
                    series.size(), titles ? "title 'Pareto front'" : "notitle");
    for (std::size_t i = 0; i < series.size(); ++i) {
        command += fmt::format(
            ", ${} index {} using 1:2 with linespoints lw 1.5 dt {} pt {} ps {} lc rgb '{}' {}",
            block, i, chart_dashes(i + 1), chart_point(i), point_size, chart_colour(i + 1),
            titles ? fmt::format("title '{}'", chart_text(series[i])) : "notitle");
    }
    return command + "\n";
}

// The range of the points with a little room, and ticks at 1, 2 and 5 of each decade; more of
// them where the range is less than one.
std::string cost_axis(const ParetoPanel& panel, ParetoCost cost) {
    constexpr double kRoom = 1.15;
    double least = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const Summary& summary : panel.summaries) {
        const double value = cost_and_error(summary, cost).cost;
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    const std::vector<double> steps = largest < 6 * least
                                          ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
                                          : std::vector<double>{1, 2, 5};
    std::vector<std::string> ticks;
    for (double decade = std::pow(10, std::floor(std::log10(least))); decade < largest * kRoom;
         decade *= 10) {
        for (const double step : steps) {
            ticks.push_back(fmt::format("{:g}", step * decade));
        }
    }
    return fmt::format("set xrange [{:.4g}:{:.4g}]\nset xtics ({})\n", least / kRoom,
                       largest * kRoom, fmt::join(ticks, ","));
}

constexpr const char* kLogarithmic =
    "set logscale xy\nset format y '10^{%L}'\nset format x '%g'\n";

}  // namespace

CostAndError cost_and_error(const Summary& summary, ParetoCost cost) {
    return {.cost = cost == ParetoCost::milliseconds ? summary.microseconds / 1e3
                                                     : summary.bytes / 1e3,
            .error = std::max(summary.l2, kLeastError)};
}

const char* axis_of(ParetoCost cost) {
    return cost == ParetoCost::milliseconds ? "milliseconds an image, median"
                                            : "kB of transport read an image, mean";
}

std::string series_of(const std::string& method) {
    // The budget is the first part that begins with a digit.
    std::string series;
    std::size_t first = 0;
    while (first <= method.size()) {
        const std::size_t dash = std::min(method.find('-', first), method.size());
        const std::string part = method.substr(first, dash - first);
        if (part.empty() || part[0] < '0' || part[0] > '9') {
            series += (series.empty() ? "" : "-") + part;
        }
        first = dash + 1;
    }
    return series;
}

void draw_pareto_chart(const std::filesystem::path& stem, const ParetoPanel& panel) {
    const std::vector<std::string> series = series_in(panel.summaries);
    Chart chart{.width = 1100, .height = 520};
    chart.data = panel_block("ms", panel, ParetoCost::milliseconds) +
                 panel_block("bytes", panel, ParetoCost::bytes);
    chart.commands =
        chart_style() + kLogarithmic +
        fmt::format(
            "set multiplot layout 1,2 title '{}: error against cost, while the light "
            "moves'\nset tmargin 3\nset bmargin 4\nset xtics rotate by 0\n",
            chart_text(panel.title)) +
        fmt::format(
            "set xlabel '{}'\nset ylabel 'mean relative L2 error of the image'\n"
            "set key bottom left\n",
            axis_of(ParetoCost::milliseconds)) +
        cost_axis(panel, ParetoCost::milliseconds) + plot_command("ms", series, 0.8, true) +
        fmt::format("set xlabel '{}'\n", axis_of(ParetoCost::bytes)) +
        cost_axis(panel, ParetoCost::bytes) + plot_command("bytes", series, 0.8, false) +
        "unset multiplot\n";
    draw_chart(stem, chart);
}

void draw_pareto_multiples(const std::filesystem::path& stem,
                           const std::vector<ParetoPanel>& panels,
                           std::size_t columns,
                           ParetoCost cost) {
    constexpr std::uint32_t kPanel = 250;
    constexpr std::uint32_t kKey = 96;
    const std::size_t rows = (panels.size() + columns - 1) / columns;
    const std::vector<std::string> series = series_in(panels.front().summaries);
    Chart chart{.width = static_cast<std::uint32_t>(columns) * kPanel,
                .height = static_cast<std::uint32_t>(rows) * kPanel + kKey};
    chart.commands = chart_style() + kLogarithmic +
                     fmt::format(
                         "set multiplot\nset lmargin 0\nset rmargin 0\nset tmargin 0\n"
                         "set bmargin 0\nset tics font ',9'\n");
    const double key = static_cast<double>(kKey) / chart.height;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const std::string block = fmt::format("panel{}", i);
        chart.data += panel_block(block, panels[i], cost);
        const double width = 1.0 / static_cast<double>(columns);
        const double height = (1 - key) / static_cast<double>(rows);
        const double left = static_cast<double>(i % columns) * width;
        const double bottom = 1 - key - static_cast<double>(i / columns + 1) * height;
        chart.commands += fmt::format(
            "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
            "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
            "set title '{}' offset 0,-0.7 font ',11'\n",
            left + 0.17 * width, left + 0.97 * width, bottom + 0.16 * height,
            bottom + 0.90 * height, chart_text(panels[i].title));
        chart.commands += cost_axis(panels[i], cost) + plot_command(block, series, 0.45, false);
    }
    // The key in a panel of its own, above all others.
    chart.commands += fmt::format(
        "unset title\nunset border\nunset tics\nunset logscale\nset lmargin at screen 0\n"
        "set rmargin at screen 1\nset bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n"
        "set xrange [0:1]\nset yrange [0:1]\nset key center center horizontal maxrows 2\n"
        "set label 'mean relative L2 error against {}' at screen 0.5,{:.4f} center font "
        "',11'\n",
        1 - 0.9 * key, 1 - 0.25 * key, axis_of(cost), 1 - 0.14 * key);
    std::string legend =
        "plot 2 notitle, keyentry with lines lw 3 lc rgb '#c8c8c8' title 'Pareto front'";
    for (std::size_t i = 0; i < series.size(); ++i) {
        legend += fmt::format(", keyentry with linespoints dt {} pt {} lc rgb '{}' title '{}'",
                              chart_dashes(i + 1), chart_point(i), chart_colour(i + 1),
                              chart_text(series[i]));
    }
    chart.commands += legend + "\nunset multiplot\n";
    draw_chart(stem, chart);
}

}  // namespace relume::lab
