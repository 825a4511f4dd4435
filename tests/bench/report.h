// What was measured, for programs and for people.
#pragma once

#include "tests/bench/figure.h"
#include "tests/bench/workbench.h"

#include <string>

namespace relume::bench {

// One object: every key with its number, or null, and "context": machine, kernel target, read
// bandwidth, scenes, what the figures were computed from, and why a figure is null.
[[nodiscard]] std::string json_report(Workbench& workbench, const Results& results);

// A line per figure with its target and whether it is met.
[[nodiscard]] std::string table_report(Workbench& workbench, const Results& results);

}  // namespace relume::bench
