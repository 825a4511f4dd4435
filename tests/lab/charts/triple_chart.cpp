#include "tests/lab/charts/triple_chart.h"

#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

namespace relume::lab {

void draw_triple_chart(const std::filesystem::path& stem,
                       const std::vector<std::string>& names,
                       const std::vector<TermCurve>& curves) {
    Chart chart{.width = 1000, .height = 520};
    std::string plots[2] = {"plot ", "plot "};
    for (std::size_t i = 0; i < curves.size(); ++i) {
        chart.data += fmt::format("$curve{} << EOD\n", i);
        for (const TermPoint& point : curves[i].points) {
            chart.data += fmt::format("{} {:.5g} {:.5g}\n", point.terms, point.microseconds,
                                      100 * point.error);
        }
        chart.data += "EOD\n";
        // Through the last point.
        const TermPoint& last = curves[i].points.back();
        const TermPoint& first = curves[i].points[curves[i].points.size() / 2];
        const std::string line = fmt::format("{:.6g}*(x/{}.0)**{:.4g}", last.microseconds,
                                             last.terms, curves[i].slope);
        for (std::size_t panel = 0; panel < 2; ++panel) {
            plots[panel] += fmt::format(
                "{}$curve{} using 1:{} with linespoints lw 2 pt {} ps 0.7 lc rgb '{}' title "
                "'{}'",
                i == 0 ? "" : ", ", i, panel + 2, chart_point(i), chart_colour(i + 1),
                chart_text(names[i]));
        }
        plots[0] += fmt::format(
            ", [{}:{}] {} with lines dt 3 lw 1.5 lc rgb '#555555' title 'slope {:.2f}', "
            "[*:*] {:.5g} with lines dt 2 lw 1.5 lc rgb '{}' title '{}, over open texels'",
            first.terms, last.terms, line, curves[i].slope, curves[i].microseconds_bits,
            chart_colour(i + 1), chart_text(names[i]));
    }
    chart.commands =
        chart_style() + fmt::format(
                            "set multiplot layout 1,2\nset logscale xy\nset format y '%g'\nset "
                            "xlabel 'terms of light "
                            "and of material'\nset key below maxcols 2 samplen 2\nset ylabel "
                            "'µs a vertex'\n{}\n"
                            "set ylabel 'relative L2 error, %'\n{}\n"
                            "unset multiplot\n",
                            plots[0], plots[1]);
    draw_chart(stem, chart);
}

void draw_triple_pareto(const std::filesystem::path& stem, const TriplePareto& pareto) {
    constexpr std::uint32_t kPanel = 440;
    Chart chart{.width = kPanel * static_cast<std::uint32_t>(pareto.panels.size()),
                .height = 560};
    chart.commands =
        chart_style() + fmt::format(
                            "set multiplot layout 1,{}\nset logscale xy\nset format '%g'\n"
                            "set xlabel 'ms an image'\nset ylabel 'relative L2 error, %'\n"
                            "set key below maxcols 2 samplen 2\n",
                            pareto.panels.size());
    for (std::size_t i = 0; i < pareto.panels.size(); ++i) {
        const TripleParetoPanel& panel = pareto.panels[i];
        std::vector<std::string> series;
        std::vector<std::string> blocks;
        for (const TripleParetoPoint& point : panel.points) {
            if (series.empty() || series.back() != point.series) {
                series.push_back(point.series);
                blocks.emplace_back();
            }
            blocks.back() +=
                fmt::format("{:.5g} {:.5g}\n", point.milliseconds, 100 * point.error);
        }
        std::string plot = "plot ";
        for (std::size_t s = 0; s < series.size(); ++s) {
            chart.data += fmt::format("$series{}x{} << EOD\n{}EOD\n", i, s, blocks[s]);
            plot += fmt::format(
                "{}$series{}x{} using 1:2 with linespoints lw 1.8 dt {} pt {} ps 0.8 lc rgb "
                "'{}' title '{}'",
                s == 0 ? "" : ", ", i, s, chart_dashes(s), chart_point(s), chart_colour(s),
                chart_text(series[s]));
        }
        chart.commands +=
            fmt::format("set title '{} moving'\n{}\n", chart_text(panel.moving), plot);
    }
    chart.commands += "unset multiplot\n";
    draw_chart(stem, chart);
}

}  // namespace relume::lab
