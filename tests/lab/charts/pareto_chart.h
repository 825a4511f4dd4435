// Error against cost, with the front that no method beats.
#pragma once

#include "tests/lab/measures/pareto.h"
#include "tests/lab/measures/summary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Methods of one run; a series is a method at several budgets.
struct ParetoPanel {
    std::string title;
    std::vector<Summary> summaries;
};

enum class ParetoCost : std::uint8_t { milliseconds, bytes };
// In milliseconds or kB, with what it counts; errors below 10⁻⁶ are rounding, and that.
[[nodiscard]] CostAndError cost_and_error(const Summary& summary, ParetoCost cost);
[[nodiscard]] const char* axis_of(ParetoCost cost);

// The method's label without its budget: "pbi-30-area" is of series "pbi-area".
[[nodiscard]] std::string series_of(const std::string& method);

// STEM.svg and .png: mean relative L2 error of the moving images against the median of
// milliseconds, and against the mean of bytes, side by side. Throws as draw_chart does.
void draw_pareto_chart(const std::filesystem::path& stem, const ParetoPanel& panel);

// STEM.svg and .png: the same against one cost for many panels, so many a row.
void draw_pareto_multiples(const std::filesystem::path& stem,
                           const std::vector<ParetoPanel>& panels,
                           std::size_t columns,
                           ParetoCost cost);

}  // namespace relume::lab
