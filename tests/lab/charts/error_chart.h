// Error over images, a curve a method, drawn by gnuplot.
#pragma once

#include "tests/lab/measures/record.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Writes FILE.svg and FILE.png (the stem is given without extension). Resets are marked as
// dots on their curves. Throws std::runtime_error when gnuplot is missing or fails.
void draw_error_chart(const std::filesystem::path& stem,
                      const std::string& title,
                      const std::vector<Record>& records);

}  // namespace relume::lab
