// Charts of one run: what every method did, image by image.
#pragma once

#include "tests/lab/measures/record.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relume::lab {

struct RunChartInput {
    std::filesystem::path folder;
    std::string title;
    const std::vector<Record>& records;
    std::uint32_t rests_from = 0;  // marked by a line where it is within the run
};

// Each writes NAME.svg and NAME.png into the folder and throws as draw_chart does.

// error: relative L2 error of the image; images that reset bands are dots [Overbeck06T figs. 6.2, 6.4],
// unless all images of a method do. flicker: the change of the error, in the same way.
void draw_error_chart(const RunChartInput& input);
void draw_flicker_chart(const RunChartInput& input);

// coverage: distinct coefficients added so far [Overbeck06T fig. 5.3].
void draw_coverage_chart(const RunChartInput& input);

// bands: how many coefficients of each band were added, over the whole run [Overbeck06T fig. 5.3].
void draw_band_chart(const RunChartInput& input);

// energy: a panel for the change of the light and one for every method's residual, image
// across, band up, log₁₀ of the energy per coefficient of the band [Overbeck06T fig. 5.4].
void draw_energy_map(const RunChartInput& input);

}  // namespace relume::lab
