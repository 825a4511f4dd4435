// What one run leaves in its folder.
#pragma once

#include "tests/lab/measures/experiment.h"

#include <filesystem>
#include <string>

namespace relume::lab {

// records.csv, run.json, charts (run_charts.h) as SVG and PNG, a sheet of pictures for every
// image that was kept, and report.html, which holds them all. A run that was interrupted is
// marked in run.json ("complete": false), in the report and in the charts' titles. Each file is
// written whole or not at all, the report last.
void write_run_report(const std::filesystem::path& folder,
                      const std::string& title,
                      const Experiment& experiment,
                      const Findings& findings);

}  // namespace relume::lab
