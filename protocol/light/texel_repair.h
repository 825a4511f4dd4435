// Real HDR files hold negative, NaN and infinite texels; lighting must not.
#pragma once

#include "protocol/light/environment_map.h"

#include <string>
#include <vector>

namespace relume::light {

// Both change the image in place and return one sentence per kind of repair with its count.

// +∞ (what a half float makes of a sun) becomes 65504, or the brightest finite value of the
// image if that is more; NaN and −∞ become the mean of the finite texels around them, from the
// nearest ring that has one. Throws EnvironmentError if more than one texel in a hundred (and
// more than one) is not finite.
std::vector<std::string> replace_non_finite(MapImage& image);

// Negatives become 0; what is above kMaxTexelRadiance becomes that. All values are finite.
std::vector<std::string> limit_texels(MapImage& image);

}  // namespace relume::light
