// What a run of the suite leaves in its folder.
#pragma once

#include "tests/stability/findings_text.h"

#include <filesystem>
#include <span>

namespace relume::stability {

// stability.json, a PNG for every failure that has pictures, and report.html, which holds
// tables and pictures. Each file is written whole or not at all, the report last. `complete` is
// false for a run that was interrupted, and the report says so.
void write_report(const std::filesystem::path& folder,
                  std::span<const Result> results,
                  bool complete);

}  // namespace relume::stability
