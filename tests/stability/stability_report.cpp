#include "tests/stability/stability_report.h"

#include "protocol/base/files/atomic_file.h"
#include "tests/lab/report/html_page.h"
#include "tests/stability/contact_sheet.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace relume::stability {
namespace {

void add_findings(const Result& result, lab::HtmlPage& page) {
    std::vector<std::vector<std::string>> rows;
    for (const Finding& finding : result.outcome.findings) {
        rows.push_back({finding.measure, bound_text(finding),
                        fmt::format("{:.3g}", finding.measured), verdict_text(finding),
                        finding.reason});
    }
    page.table({"measure", "bound", "measured", "verdict", "why this bound"}, rows);
}

}  // namespace

void write_report(const std::filesystem::path& folder,
                  std::span<const Result> results,
                  bool complete) {
    std::filesystem::create_directories(folder);
    const std::string json = json_from(results).dump(2);
    files::write_file_atomically(folder / "stability.json", {files::bytes_of(json)});
    lab::HtmlPage page("Where the methods fail");
    if (!complete) {
        page.warning(fmt::format("Interrupted after {} failures.", results.size()));
    }
    for (const Result& result : results) {
        page.heading(std::string(result.failure.name));
        page.paragraph(
            fmt::format("{}. Scene: {}.", result.failure.what, result.failure.scene));
        if (!result.holds()) {
            page.warning("A bound is broken.");
        }
        if (!result.outcome.tiles.empty()) {
            const auto file = folder / (std::string(result.failure.name) + ".png");
            write_contact_sheet(file, result.outcome.tiles);
            page.png(file);
        }
        add_findings(result, page);
    }
    page.write(folder / "report.html");
}

}  // namespace relume::stability
