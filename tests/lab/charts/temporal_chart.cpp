#include "tests/lab/charts/temporal_chart.h"

#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

#include <cmath>

namespace relume::lab {

void draw_temporal_chart(const std::filesystem::path& stem,
                         const std::string& title,
                         const TemporalSpectrum& spectrum) {
    const std::size_t temporal_bands = spectrum.energy.front().size();
    Chart chart{.width = 620, .height = 470, .data = "$energy << EOD\n"};
    for (std::size_t b = 0; b < spectrum.energy.size(); ++b) {
        for (std::size_t t = 0; t < temporal_bands; ++t) {
            const double energy = spectrum.energy[b][t];
            chart.data +=
                fmt::format("{} {} {}\n", b, t,
                            energy > 0 ? fmt::format("{:.3f}", std::log10(energy)) : "NaN");
        }
    }
    chart.data += "EOD\n";
    std::string tics;
    for (std::size_t t = 0; t < temporal_bands; ++t) {
        // The mean, then the images that one difference spans.
        const std::string label =
            t == 0 ? "mean" : fmt::format("{}", spectrum.images >> (t - 1));
        tics += fmt::format("{}'{}' {}", t == 0 ? "" : ", ", label, t);
    }
    chart.commands = fmt::format(
        "set title '{}: log_{{10}} of the energy, first {} images'\n"
        "set palette defined (0 '#fff7ec', 0.5 '#fc8d59', 1 '#7f0000')\n"
        "set border 3\nset tics nomirror out\nset xlabel 'band of the light (0: coarsest)'\n"
        "set ylabel 'images that a change spans'\nset xtics 1\nset ytics ({})\n"
        "set yrange [{}.5:-0.5]\nset autoscale xfix\n"
        "plot $energy using 1:2:3 with image notitle\n",
        chart_text(title), spectrum.images, tics, temporal_bands - 1);
    draw_chart(stem, chart);
}

}  // namespace relume::lab
