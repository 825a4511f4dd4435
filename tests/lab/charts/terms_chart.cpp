#include "tests/lab/charts/terms_chart.h"

#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

namespace relume::lab {
namespace {

// "nwa-{}-area" is "nwa-k-area".
std::string series_name(std::string form) {
    return chart_text(form.replace(form.find("{}"), 2, "k"));
}

}  // namespace

void draw_terms_chart(const std::filesystem::path& stem,
                      const std::string& title,
                      const std::vector<TermsCurve>& curves) {
    Chart chart{.width = 1100, .height = 460};
    std::string plots[2] = {"plot ", "plot "};
    for (std::size_t i = 0; i < curves.size(); ++i) {
        chart.data += fmt::format("$curve{} << EOD\n", i);
        for (const Record& record : curves[i].records) {
            chart.data += fmt::format("{} {:.6e} {:.6e}\n", record.applied, record.lighting_l1,
                                      record.error.l2);
        }
        chart.data += "EOD\n";
        for (std::size_t panel = 0; panel < 2; ++panel) {
            plots[panel] += fmt::format(
                "{}$curve{} using 1:{} with linespoints lw 2 pt {} ps 0.6 lc rgb '{}' title "
                "'{}'",
                i == 0 ? "" : ", ", i, panel + 2, chart_point(i), chart_colour(i + 1),
                series_name(curves[i].name));
        }
    }
    chart.commands = chart_style() +
                     fmt::format(
                         "set multiplot layout 1,2 title '{}'\nset tmargin 3\nset bmargin 4\n"
                         "set logscale xy\nset format y '10^{{%L}}'\nset key bottom left\n"
                         "set xlabel 'coefficients'\n"
                         "set ylabel 'relative L1 error of the lighting'\n{}\n"
                         "set ylabel 'relative L2 error of the image'\n{}\nunset multiplot\n",
                         chart_text(title), plots[0], plots[1]);
    draw_chart(stem, chart);
}

}  // namespace relume::lab
