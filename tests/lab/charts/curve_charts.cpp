// Charts of a curve a method over images.
#include "tests/lab/charts/gnuplot.h"
#include "tests/lab/charts/run_charts.h"
#include "tests/lab/measures/summary.h"

#include <fmt/format.h>

#include <algorithm>

namespace relume::lab {
namespace {

struct CurveChart {
    std::string name;
    std::string axis;
    double (*value)(const Record&);
    bool logarithmic;
    bool mark_resets;
};

bool resets_always(const std::vector<Record>& records) {
    return std::all_of(records.begin(), records.end(),
                       [](const Record& record) { return record.bands_reset != 0; });
}

struct Curve {
    std::string method;
    std::string points;  // rows image value
    std::string resets;  // those of images that reset bands
};

std::vector<Curve> curves_of(const std::vector<Record>& records, const CurveChart& chart) {
    std::vector<Curve> curves;
    for (const std::string& method : methods_of(records)) {
        Curve curve{.method = method, .points = "", .resets = ""};
        const std::vector<Record> own = records_of(records, method);
        const bool mark = chart.mark_resets && !resets_always(own);
        for (const Record& record : own) {
            const std::string point =
                fmt::format("{} {:.6e}\n", record.image, chart.value(record));
            curve.points += point;
            curve.resets += mark && record.bands_reset != 0 ? point : "";
        }
        curves.push_back(curve);
    }
    return curves;
}

std::string data_blocks(const std::vector<Curve>& curves) {
    std::string blocks;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        blocks += fmt::format("$curve{0} << EOD\n{1}EOD\n$resets{0} << EOD\n{2}EOD\n", i,
                              curves[i].points, curves[i].resets);
    }
    return blocks;
}

std::string plot_command(const std::vector<Curve>& curves) {
    std::string command = "plot ";
    bool any_resets = false;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        command +=
            fmt::format("{}$curve{} using 1:2 with lines lw 2 lc rgb '{}' title '{}'",
                        i == 0 ? "" : ", ", i, chart_colour(i), chart_text(curves[i].method));
        if (!curves[i].resets.empty()) {
            any_resets = true;
            command +=
                fmt::format(", $resets{} using 1:2 with points pt 7 ps 0.9 lc rgb '{}' notitle",
                            i, chart_colour(i));
        }
    }
    if (any_resets) {
        command += ", keyentry with points pt 7 ps 0.9 lc rgb '#000000' title 'bands reset'";
    }
    return command + "\n";
}

std::string rest_mark(const RunChartInput& input) {
    if (input.records.empty() || input.rests_from > input.records.back().image) {
        return "";
    }
    return fmt::format(
        "set arrow from {0}, graph 0 to {0}, graph 1 nohead dt 2 lc rgb '#888888'\n"
        "set label 'rests' at {0}, graph 0.97 offset 0.5,0 tc rgb '#666666'\n",
        input.rests_from);
}

void draw_curves(const RunChartInput& input, const CurveChart& curves) {
    const std::vector<Curve> drawn = curves_of(input.records, curves);
    Chart chart;
    chart.data = data_blocks(drawn);
    chart.commands = chart_style() + fmt::format(
                                         "set title '{}'\nset xlabel 'image'\nset ylabel '{}'\n"
                                         "set key outside right top\n",
                                         chart_text(input.title), curves.axis);
    if (curves.logarithmic) {
        chart.commands += "set logscale y\nset format y '10^{%L}'\n";
    }
    chart.commands += rest_mark(input) + plot_command(drawn);
    draw_chart(input.folder / curves.name, chart);
}

}  // namespace

void draw_error_chart(const RunChartInput& input) {
    draw_curves(input, {.name = "error",
                        .axis = "relative L2 error of the image",
                        .value = [](const Record& r) { return r.error.l2; },
                        .logarithmic = true,
                        .mark_resets = true});
}

void draw_flicker_chart(const RunChartInput& input) {
    draw_curves(input, {.name = "flicker",
                        .axis = "change of the error, relative L2",
                        .value = [](const Record& r) { return r.flicker; },
                        .logarithmic = true,
                        .mark_resets = true});
}

void draw_coverage_chart(const RunChartInput& input) {
    draw_curves(input, {.name = "coverage",
                        .axis = "distinct coefficients added so far",
                        .value = [](const Record& r) { return static_cast<double>(r.covered); },
                        .logarithmic = false,
                        .mark_resets = false});
}

}  // namespace relume::lab
