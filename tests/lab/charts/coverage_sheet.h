// Which parts of the light's sphere methods bring up to date, how finely.
#pragma once

#include "tests/lab/measures/coverage.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

// Writes STEM.png: a column a method; above, the levels that cover each texel in one image,
// below, in the last kCoverageImages images together, the darker the more. Faces lie as a
// horizontal cross: −X, −Z, +X, +Z beside one another, +Y above −Z and −Y below it
// [Overbeck06T fig. 5.3]. `coverages` are of one image. Throws as draw_chart does.
void draw_coverage_sheet(const std::filesystem::path& stem,
                         const std::string& title,
                         const std::vector<Coverage>& coverages,
                         std::uint32_t face_resolution);

}  // namespace relume::lab
