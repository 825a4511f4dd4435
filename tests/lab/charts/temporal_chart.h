// How fast a light changes at every scale.
#pragma once

#include "tests/lab/measures/temporal_bands.h"

#include <filesystem>
#include <string>

namespace relume::lab {

// Writes STEM.svg and STEM.png: spatial bands across, coarsest first, temporal bands down, the
// longest first, log₁₀ of the energy [Overbeck06T fig. 5.4]. A diagonal tells that finer bands
// keep less from image to image. Throws as draw_chart does.
void draw_temporal_chart(const std::filesystem::path& stem,
                         const std::string& title,
                         const TemporalSpectrum& spectrum);

}  // namespace relume::lab
