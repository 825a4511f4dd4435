#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

struct ClosePipe {
    void operator()(std::FILE* pipe) const { ::pclose(pipe); }
};

void run_gnuplot(const std::string& script) {
    std::unique_ptr<std::FILE, ClosePipe> gnuplot(::popen("gnuplot", "w"));
    if (!gnuplot || std::fputs(script.c_str(), gnuplot.get()) < 0 ||
        ::pclose(gnuplot.release()) != 0) {
        throw std::runtime_error("gnuplot: expected it to be installed and to draw the chart");
    }
}

// One format: drawn aside, then put in its place.
void draw(const fs::path& file, const std::string& terminal, const Chart& chart) {
    fs::path aside = file;
    aside += ".part";
    run_gnuplot(fmt::format("set terminal {}\nset output '{}'\n{}{}\nset output\n", terminal,
                            aside.string(), chart.data, chart.commands));
    fs::rename(aside, file);
}

fs::path with_extension(const fs::path& stem, const char* extension) {
    fs::path file = stem;
    file += extension;
    return file;
}

}  // namespace

void draw_chart(const fs::path& stem, const Chart& chart) {
    draw(with_extension(stem, ".svg"),
         fmt::format("svg size {},{} font 'sans,13' background '#ffffff'", chart.width,
                     chart.height),
         chart);
    draw_picture(stem, chart);
}

void draw_picture(const fs::path& stem, const Chart& chart) {
    draw(with_extension(stem, ".png"),
         fmt::format("pngcairo size {},{} font 'sans,13' fontscale 1.4 linewidth 1.5",
                     chart.width * 3 / 2, chart.height * 3 / 2),
         chart);
}

namespace {

const char* const kColours[] = {"#999999", "#56B4E9", "#0072B2", "#D55E00",
                                "#009E73", "#CC79A7", "#E69F00", "#000000"};

}  // namespace

const char* chart_colour(std::size_t n) {
    return kColours[n % std::size(kColours)];
}

std::size_t chart_dashes(std::size_t n) {
    return 1 + n / std::size(kColours);
}

int chart_point(std::size_t n) {
    static const int kPoints[] = {7, 5, 9, 11, 13, 6, 4, 8, 10, 12};
    return kPoints[n % std::size(kPoints)];
}

std::string chart_text(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '_' || c == '^' || c == '{' || c == '}' || c == '@' || c == '&') {
            escaped += '\\';
        }
        escaped += c;
        if (c == '\'') {
            escaped += '\'';
        }
    }
    return escaped;
}

std::string chart_style() {
    return "set border 3\nset tics nomirror\nset grid lc rgb '#dddddd'\n";
}

}  // namespace relume::lab
