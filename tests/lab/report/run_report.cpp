#include "tests/lab/report/run_report.h"

#include "protocol/base/files/atomic_file.h"
#include "tests/lab/charts/coverage_sheet.h"
#include "tests/lab/charts/picture_sheet.h"
#include "tests/lab/charts/run_charts.h"
#include "tests/lab/charts/temporal_chart.h"
#include "tests/lab/measures/record_table.h"
#include "tests/lab/measures/summary.h"
#include "tests/lab/report/html_page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace relume::lab {
namespace {

namespace fs = std::filesystem;

nlohmann::json json_from_run(const Experiment& experiment, const Findings& findings) {
    return {{"sequence", experiment.sequence.name},
            {"seed", experiment.sequence.seed},
            {"images", experiment.sequence.images},
            {"images_done", findings.images_done},
            {"complete", findings.complete},
            {"rests_from", experiment.sequence.rests_from()},
            {"transport", experiment.scene.haar->transport().directory().string()},
            {"records", json_from_records(findings.records)}};
}

void write_text(const fs::path& file, const std::string& text) {
    files::write_file_atomically(file, {files::bytes_of(text)});
}

std::vector<Picture> pictures_of_image(const Findings& findings, std::uint32_t image) {
    std::vector<Picture> pictures;
    std::copy_if(findings.pictures.begin(), findings.pictures.end(),
                 std::back_inserter(pictures),
                 [&](const Picture& picture) { return picture.image == image; });
    return pictures;
}

void add_coverage(const fs::path& folder,
                  const std::string& title,
                  const Experiment& experiment,
                  const Findings& findings,
                  std::uint32_t image,
                  HtmlPage& page) {
    std::vector<Coverage> coverages;
    std::copy_if(findings.coverages.begin(), findings.coverages.end(),
                 std::back_inserter(coverages),
                 [&](const Coverage& coverage) { return coverage.image == image; });
    if (coverages.empty()) {
        return;
    }
    const fs::path stem = folder / fmt::format("coverage-{:03}", image);
    draw_coverage_sheet(stem, fmt::format("{}, image {}: levels updated", title, image),
                        coverages, experiment.scene.haar->face_resolution());
    page.png(stem.string() + ".png");
}

void add_summary(const Experiment& experiment, const Findings& findings, HtmlPage& page) {
    const auto number = [](double value) { return fmt::format("{:.3g}", value); };
    std::vector<std::vector<std::string>> rows;
    for (const Summary& s : summaries(findings.records, experiment.sequence.rests_from())) {
        rows.push_back(
            {s.method, number(s.l2), number(s.h1), number(s.lighting_l1), number(s.flicker),
             number(s.delta_e), number(s.soon_l2), number(s.later_l2), number(s.last_l2),
             fmt::format("{:.2f} to {:.2f}", s.least_stated_ratio, s.largest_stated_ratio),
             number(s.bytes / 1e3), number(s.microseconds)});
    }
    page.heading("Summary");
    page.paragraph(fmt::format(
        "Means over the {} images while the light moves, of times the median; then "
        "the L2 error {} and {} images after it rests and of the last image. Errors "
        "are relative to the dense product of the stored transport.",
        experiment.sequence.rests_from(), kSoon, kLater));
    page.table({"method", "L2", "H1", "lighting L1", "flicker", "ΔE*ab",
                fmt::format("rest +{}", kSoon), fmt::format("rest +{}", kLater), "last",
                "stated / true", "kB", "µs"},
               rows);
}

}  // namespace

void write_run_report(const fs::path& folder,
                      const std::string& title,
                      const Experiment& experiment,
                      const Findings& findings) {
    fs::create_directories(folder);
    write_text(folder / "records.csv", csv_from_records(findings.records));
    write_text(folder / "run.json", json_from_run(experiment, findings).dump());
    const std::string partial =
        findings.complete ? ""
                          : fmt::format(" (partial: {} of {} images)", findings.images_done,
                                        experiment.sequence.images);
    const RunChartInput input{.folder = folder,
                              .title = title + partial,
                              .records = findings.records,
                              .rests_from = experiment.sequence.rests_from()};
    HtmlPage page(input.title);
    if (!findings.complete) {
        page.warning("The run was interrupted" + partial + ".");
    }
    page.paragraph(experiment.sequence.description +
                   fmt::format(" Seed {}.", experiment.sequence.seed));
    add_summary(experiment, findings, page);
    const auto add_chart = [&](const char* heading, const char* name, const auto& draw) {
        draw(input);
        page.heading(heading);
        page.svg(folder / (std::string(name) + ".svg"));
    };
    add_chart("Error", "error", draw_error_chart);
    add_chart("Flicker", "flicker", draw_flicker_chart);
    add_chart("Coverage", "coverage", draw_coverage_chart);
    add_chart("Updates by band", "bands", draw_band_chart);
    add_chart("Energy by band and image", "energy", draw_energy_map);
    if (findings.spectrum.images > 1) {
        draw_temporal_chart(folder / "temporal", input.title, findings.spectrum);
        page.heading("Energy by band and duration of change");
        page.svg(folder / "temporal.svg");
    }
    for (const std::uint32_t image : experiment.pictures) {
        const std::vector<Picture> pictures = pictures_of_image(findings, image);
        if (!pictures.empty()) {
            const fs::path stem = folder / fmt::format("pictures-{:03}", image);
            draw_picture_sheet(stem, fmt::format("{}, image {}", title, image), pictures,
                               experiment.scene.haar->image().width);
            page.heading(fmt::format("Image {}", image));
            page.png(stem.string() + ".png");
            add_coverage(folder, title, experiment, findings, image, page);
        }
    }
    page.write(folder / "report.html");
}

}  // namespace relume::lab
