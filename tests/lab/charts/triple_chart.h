// Time and error of a triple product integral against its terms.
#pragma once

#include "tests/lab/triple/triple_experiment.h"
#include "tests/lab/triple/triple_pareto.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// STEM.svg and .png: time on the left, error on the right, a curve a material, with the line
// of its slope, and the time of the sum over open texels as a line. Throws as draw_chart does.
void draw_triple_chart(const std::filesystem::path& stem,
                       const std::vector<std::string>& names,
                       const std::vector<TermCurve>& curves);

// STEM.svg and .png: error against time, a panel for what moves, a curve a series. Throws as
// draw_chart does.
void draw_triple_pareto(const std::filesystem::path& stem, const TriplePareto& pareto);

}  // namespace relume::lab
