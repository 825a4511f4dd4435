#include "tests/lab/charts/picture_sheet.h"

#include "protocol/wire/display.h"
#include "tests/lab/charts/gnuplot.h"
#include "tests/lab/measures/display_exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace relume::lab {
namespace {

// Display values in [0, 1].
std::vector<float> display_values(std::span<const float> rgb, const wire::Display& display) {
    std::vector<float> values;
    values.reserve(rgb.size());
    for (const float value : rgb) {
        values.push_back(wire::srgb_from_linear(wire::tone_mapped(value, display)));
    }
    return values;
}

std::vector<float> shown_error(const std::vector<float>& values,
                               const std::vector<float>& reference) {
    constexpr float kAmplification = 4;
    std::vector<float> error;
    for (std::size_t i = 0; i < values.size(); ++i) {
        error.push_back(std::min(kAmplification * std::abs(values[i] - reference[i]), 1.0F));
    }
    return error;
}

// A data block of rows x y red green blue, y upwards.
std::string pixel_block(const std::string& name,
                        const std::vector<float>& values,
                        std::uint32_t width) {
    std::string block = fmt::format("${} << EOD\n", name);
    const std::size_t height = values.size() / 3 / width;
    for (std::size_t i = 0; i < values.size(); i += 3) {
        const std::size_t pixel = i / 3;
        block += fmt::format("{} {}", pixel % width, height - 1 - pixel / width);
        for (std::size_t c = 0; c < 3; ++c) {
            block += fmt::format(" {:.0f}", 255 * values[i + c]);
        }
        block += "\n";
    }
    return block + "EOD\n";
}

}  // namespace

void draw_picture_sheet(const std::filesystem::path& stem,
                        const std::string& title,
                        const std::vector<Picture>& pictures,
                        std::uint32_t width) {
    constexpr std::uint32_t kColumn = 200;
    const wire::Display display = display_for(pictures.front().rgb);
    const std::vector<float> reference = display_values(pictures.front().rgb, display);
    const auto columns = static_cast<std::uint32_t>(pictures.size());
    const std::size_t height = reference.size() / 3 / width;
    const auto row = static_cast<std::uint32_t>(kColumn * height / width);
    Chart chart{.width = columns * kColumn, .height = 2 * row + 80};
    chart.commands = fmt::format(
        "set multiplot layout 2,{} title '{}' margins 0.004,0.996,0.01,0.86 "
        "spacing 0.004,0.07\nunset border\nunset tics\nunset key\nunset colorbox\n"
        "set size ratio -1\nset xrange [-0.5:{}.5]\nset yrange [-0.5:{}.5]\n",
        columns, chart_text(title), width - 1, height - 1);
    std::string errors;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const std::vector<float> values = display_values(pictures[i].rgb, display);
        chart.data += pixel_block(fmt::format("image{}", i), values, width);
        chart.commands += fmt::format(
            "set title '{}' offset 0,-0.6\nplot $image{} using 1:2:3:4:5 with rgbimage\n",
            i == 0 ? "reference" : chart_text(pictures[i].method), i);
        if (i == 0) {
            errors += "set multiplot next\nset title 'error × 4'\n";
        } else {
            chart.data +=
                pixel_block(fmt::format("error{}", i), shown_error(values, reference), width);
            errors += fmt::format("plot $error{} using 1:2:3:4:5 with rgbimage\n", i);
        }
    }
    chart.commands += errors + "unset multiplot\n";
    draw_picture(stem, chart);
}

void draw_picture_grid(const std::filesystem::path& stem,
                       const std::string& title,
                       const std::vector<float>& reference,
                       const std::vector<Picture>& pictures,
                       std::size_t columns,
                       std::uint32_t width) {
    constexpr std::uint32_t kColumn = 150;
    constexpr std::uint32_t kCaption = 22;
    const wire::Display display = display_for(reference);
    const std::size_t height = reference.size() / 3 / width;
    const std::size_t rows = (pictures.size() + columns - 1) / columns;
    const auto row = static_cast<std::uint32_t>(kColumn * height / width) + kCaption;
    Chart chart{.width = static_cast<std::uint32_t>(columns) * kColumn,
                .height = static_cast<std::uint32_t>(rows) * row + 2 * kCaption};
    const double of_caption = static_cast<double>(kCaption) / chart.height;
    chart.commands = fmt::format(
        "set multiplot layout {},{} title '{}' margins 0.003,0.997,0.003,{:.4f} "
        "spacing 0.003,{:.4f}\nunset border\nunset tics\nunset key\nunset colorbox\n"
        "set size ratio -1\nset xrange [-0.5:{}.5]\nset yrange [-0.5:{}.5]\n",
        rows, columns, chart_text(title), 1 - 2.4 * of_caption, of_caption, width - 1,
        height - 1);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        chart.data += pixel_block(fmt::format("image{}", i),
                                  display_values(pictures[i].rgb, display), width);
        chart.commands += fmt::format(
            "set title '{}' font ',8' offset 0,-0.7\nplot $image{} using 1:2:3:4:5 with rgbimage\n",
            chart_text(pictures[i].method), i);
    }
    chart.commands += "unset multiplot\n";
    draw_picture(stem, chart);
}

}  // namespace relume::lab
