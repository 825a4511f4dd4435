#include "tests/lab/charts/coverage_sheet.h"

#include "protocol/basis/cubemap.h"
#include "protocol/basis/haar.h"
#include "tests/lab/charts/gnuplot.h"

#include <fmt/format.h>

#include <array>

namespace relume::lab {
namespace {

// Where a face lies in the cross, in faces from the left and from above; in a horizontal cross
// the back stands upright.
struct Place {
    std::uint32_t column;
    std::uint32_t row;
    bool turned;  // by half a turn
};

// By face, +X −X +Y −Y +Z −Z. Faces of the cubemap are seen from inside, with OpenGL's texel
// orientation: +Y and −Y meet +Z at their upper and lower edge, so they are turned to meet −Z.
constexpr std::array<Place, basis::kFaceCount> kPlaces{
    {{2, 1, false}, {0, 1, false}, {1, 0, true}, {1, 2, true}, {3, 1, false}, {1, 1, false}}};

// Rows x y level, y upwards; no row where the cross has no face.
std::string level_block(const std::string& name,
                        const std::vector<std::uint8_t>& levels,
                        std::uint32_t n) {
    std::string block = fmt::format("${} << EOD\n", name);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const basis::Texel texel = basis::texel_from_index(n, i);
        const Place& place = kPlaces[static_cast<std::size_t>(texel.face)];
        const std::uint32_t x = place.turned ? n - 1 - texel.column : texel.column;
        const std::uint32_t y = place.turned ? n - 1 - texel.row : texel.row;
        block += fmt::format("{} {} {}\n", place.column * n + x,
                             3 * n - 1 - (place.row * n + y), levels[i]);
    }
    return block + "EOD\n";
}

}  // namespace

void draw_coverage_sheet(const std::filesystem::path& stem,
                         const std::string& title,
                         const std::vector<Coverage>& coverages,
                         std::uint32_t face_resolution) {
    constexpr std::uint32_t kColumn = 280;
    const auto columns = static_cast<std::uint32_t>(coverages.size());
    Chart chart{.width = columns * kColumn, .height = 2 * (kColumn * 3 / 4) + 110};
    chart.commands = fmt::format(
        "set multiplot layout 2,{} title '{}' margins 0.01,0.99,0.01,0.86 spacing 0.01,0.08\n"
        "unset border\nunset tics\nunset key\nunset colorbox\nset size ratio -1\n"
        "set palette defined (0 '#f2f2f2', 1 '#08306b')\nset cbrange [0:{}]\n"
        "set xrange [-0.5:{}.5]\nset yrange [-0.5:{}.5]\n",
        columns, chart_text(title), basis::band_count(face_resolution), 4 * face_resolution - 1,
        3 * face_resolution - 1);
    std::string below;
    for (std::size_t i = 0; i < coverages.size(); ++i) {
        chart.data +=
            level_block(fmt::format("one{}", i), coverages[i].levels, face_resolution);
        chart.data +=
            level_block(fmt::format("all{}", i), coverages[i].cumulative, face_resolution);
        chart.commands +=
            fmt::format("set title '{}' offset 0,-0.6\nplot $one{} using 1:2:3 with image\n",
                        chart_text(coverages[i].method), i);
        below += fmt::format(
            "set title 'last {} images' offset 0,-0.6\n"
            "plot $all{} using 1:2:3 with image\n",
            kCoverageImages, i);
    }
    chart.commands += below + "unset multiplot\n";
    draw_picture(stem, chart);
}

}  // namespace relume::lab
