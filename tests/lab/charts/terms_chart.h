// Error against the number of terms of a light that stands still [Ng03 §4.1].
#pragma once

#include "tests/lab/measures/terms_sweep.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// STEM.svg and .png: L1 error of the lighting and L2 error of the image against the number of
// coefficients added, side by side. Throws as draw_chart does.
void draw_terms_chart(const std::filesystem::path& stem,
                      const std::string& title,
                      const std::vector<TermsCurve>& curves);

}  // namespace relume::lab
