#include "tests/lab/charts/error_chart.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

namespace relume::lab {
namespace {

struct ClosePipe {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
};

std::vector<std::string> labels_in_order(const std::vector<Record>& records) {
    std::vector<std::string> labels;
    for (const Record& record : records) {
        if (record.image != records.front().image) {
            break;
        }
        labels.push_back(record.method);
    }
    return labels;
}

// The data of one curve, and where it was reset, as gnuplot data blocks.
std::string data_blocks(std::size_t number,
                        const std::string& label,
                        const std::vector<Record>& records) {
    std::string curve = fmt::format("$curve{} << EOD\n", number);
    std::string resets = fmt::format("$resets{} << EOD\n", number);
    for (const Record& record : records) {
        if (record.method == label) {
            const std::string point = fmt::format("{} {:.6e}\n", record.image, record.error.l2);
            curve += point;
            resets += record.bands_reset != 0 ? point : "";
        }
    }
    return curve + "EOD\n" + resets + "EOD\n";
}

std::string plot_command(const std::vector<std::string>& labels) {
    // Colour-blind-safe, after Okabe and Ito.
    static const char* const kColours[] = {"#999999", "#56B4E9", "#0072B2", "#D55E00",
                                           "#009E73", "#CC79A7", "#E69F00", "#000000"};
    std::string command = "plot ";
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const char* colour = kColours[i % std::size(kColours)];
        command += fmt::format("{}$curve{} using 1:2 with lines lw 2 lc rgb '{}' title '{}'",
                               i == 0 ? "" : ", ", i, colour, labels[i]);
        if (labels[i].starts_with("pbi")) {
            command += fmt::format(
                ", $resets{} using 1:2 with points pt 7 ps 0.35 lc rgb '{}' notitle", i,
                colour);
        }
    }
    return command + "\n";
}

}  // namespace

void draw_error_chart(const std::filesystem::path& stem,
                      const std::string& title,
                      const std::vector<Record>& records) {
    const auto labels = labels_in_order(records);
    std::string script;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        script += data_blocks(i, labels[i], records);
    }
    script += fmt::format(
        "set title '{}'\nset xlabel 'image'\nset ylabel 'relative L2 error of the image'\n"
        "set logscale y\nset format y '10^{{%L}}'\nset grid ytics lc rgb '#dddddd'\n"
        "set key outside right top\nset border 3\nset tics nomirror\n",
        title);
    script += fmt::format(
        "set terminal svg size 960,480 font 'sans,13' background '#ffffff'\n"
        "set output '{}.svg'\n",
        stem.string());
    script += plot_command(labels);
    script += fmt::format(
        "set terminal pngcairo size 1440,720 font 'sans,14'\n"
        "set output '{}.png'\n",
        stem.string());
    script += plot_command(labels);
    std::unique_ptr<std::FILE, ClosePipe> gnuplot(::popen("gnuplot", "w"));
    if (!gnuplot || std::fputs(script.c_str(), gnuplot.get()) < 0 ||
        ::pclose(gnuplot.release()) != 0) {
        throw std::runtime_error("gnuplot: expected it to be installed and to draw the chart");
    }
}

}  // namespace relume::lab
