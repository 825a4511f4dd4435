#include "tests/lab/charts/view_terms_chart.h"

#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

namespace relume::lab {

void draw_view_terms_chart(const std::filesystem::path& stem,
                           const std::vector<ViewTermsPanel>& panels) {
    constexpr std::uint32_t kPanel = 480;
    Chart chart{.width = kPanel * static_cast<std::uint32_t>(panels.size()), .height = 420};
    chart.commands = chart_style() + fmt::format(
                                         "set multiplot layout 1,{}\nset xlabel 'K, terms'\n"
                                         "set ylabel 'relative L2 error of the image, %'\n"
                                         "set logscale y\nset xtics 1\nset key bottom left\n",
                                         panels.size());
    for (std::size_t i = 0; i < panels.size(); ++i) {
        std::string plot = "plot ";
        for (std::size_t light = 0; light < panels[i].found.size(); ++light) {
            const std::string block = fmt::format("curve{}x{}", i, light);
            chart.data += fmt::format("${} << EOD\n", block);
            const std::vector<double>& errors = panels[i].found[light].errors;
            for (std::size_t k = 0; k < errors.size(); ++k) {
                chart.data += fmt::format("{} {:.5g}\n", k + 1, 100 * errors[k]);
            }
            chart.data += "EOD\n";
            plot += fmt::format(
                "{}${} using 1:2 with linespoints lw 2 pt {} ps 0.7 lc rgb '{}' title '{}'",
                light == 0 ? "" : ", ", block, chart_point(light), chart_colour(light + 1),
                chart_text(panels[i].lights[light]));
        }
        chart.commands +=
            fmt::format("set title '{}'\n{}\n", chart_text(panels[i].title), plot);
    }
    chart.commands += "unset multiplot\n";
    draw_chart(stem, chart);
}

}  // namespace relume::lab
