// Charts by band of the light's basis.
#include "tests/lab/charts/gnuplot.h"
#include "tests/lab/charts/run_charts.h"
#include "tests/lab/measures/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace relume::lab {
namespace {

std::size_t band_count(const std::vector<Record>& records) {
    std::size_t count = 0;
    for (const Record& record : records) {
        count = std::max(count, record.bands.size());
    }
    return count;
}

std::string histogram_block(const std::vector<Record>& records,
                            const std::vector<std::string>& methods) {
    std::string block = "$bands << EOD\n";
    const std::size_t bands = band_count(records);
    for (std::size_t b = 0; b < bands; ++b) {
        block += fmt::format("{}", b);
        for (const std::string& method : methods) {
            std::uint64_t updated = 0;
            for (const Record& record : records_of(records, method)) {
                updated += b < record.bands.size() ? record.bands[b].updated : 0;
            }
            block += fmt::format(" {}", updated);
        }
        block += "\n";
    }
    return block + "EOD\n";
}

// Of every image and band, log₁₀ of an energy, as rows image band value.
std::string map_block(const std::string& name,
                      const std::vector<Record>& records,
                      const std::function<double(const BandRecord&)>& energy) {
    std::string block = fmt::format("${} << EOD\n", name);
    for (const Record& record : records) {
        for (std::size_t b = 0; b < record.bands.size(); ++b) {
            const double value = energy(record.bands[b]);
            block += fmt::format("{} {} {}\n", record.image, b,
                                 value > 0 ? fmt::format("{:.3f}", std::log10(value)) : "NaN");
        }
    }
    return block + "EOD\n";
}

}  // namespace

void draw_band_chart(const RunChartInput& input) {
    const std::vector<std::string> methods = methods_of(input.records);
    Chart chart{.data = histogram_block(input.records, methods)};
    chart.commands =
        chart_style() +
        fmt::format(
            "set title '{}'\nset xlabel 'band of the light (0: coarsest)'\n"
            "set ylabel 'coefficients added, whole run'\nset key outside right top\n"
            "set style data histograms\nset style histogram clustered gap 1\n"
            "set style fill solid 0.9 noborder\nset boxwidth 0.9\n"
            "set logscale y\nset yrange [1:*]\nset format y '10^{{%L}}'\n",
            chart_text(input.title));
    std::string command = "plot ";
    for (std::size_t i = 0; i < methods.size(); ++i) {
        command +=
            fmt::format("{}$bands using {}:xtic(1) lc rgb '{}' title '{}'", i == 0 ? "" : ", ",
                        i + 2, chart_colour(i), chart_text(methods[i]));
    }
    chart.commands += command + "\n";
    draw_chart(input.folder / "bands", chart);
}

void draw_energy_map(const RunChartInput& input) {
    constexpr std::uint32_t kPanelHeight = 150;
    const std::vector<std::string> methods = methods_of(input.records);
    Chart chart{.height = static_cast<std::uint32_t>(methods.size() + 1) * kPanelHeight + 40};
    chart.data = map_block("map0", records_of(input.records, methods.front()),
                           [](const BandRecord& band) { return band.change_energy; });
    std::vector<std::string> titles{"change of the light asked for"};
    for (std::size_t i = 0; i < methods.size(); ++i) {
        chart.data +=
            map_block(fmt::format("map{}", i + 1), records_of(input.records, methods[i]),
                      [](const BandRecord& band) { return band.residual_energy; });
        titles.push_back("what is left, " + methods[i]);
    }
    chart.commands = fmt::format(
        "set multiplot layout {},1 margins 0.07,0.88,{:.4f},{:.4f} spacing 0,{:.4f} title "
        "'{}: log_{{10}} of the energy of all coefficients of a band'\n"
        "set palette defined (0 '#fff7ec', 0.5 '#fc8d59', 1 '#7f0000')\n"
        "set border 3\nset tics nomirror out\nset ylabel 'band'\nset ytics 1\n"
        "set autoscale xfix\nset yrange [-0.5:{}.5]\nset cbrange [-6:*]\n",
        titles.size(), 50.0 / chart.height, 1 - 60.0 / chart.height, 50.0 / chart.height,
        chart_text(input.title), band_count(input.records) - 1);
    for (std::size_t i = 0; i < titles.size(); ++i) {
        chart.commands += i + 1 == titles.size() ? "set xlabel 'image' offset 0,0.6\n" : "";
        chart.commands += fmt::format(
            "set title '{}' offset 0,-0.6\nplot $map{} using 1:2:3 with image notitle\n",
            chart_text(titles[i]), i);
    }
    chart.commands += "unset multiplot\n";
    draw_chart(input.folder / "energy", chart);
}

}  // namespace relume::lab
