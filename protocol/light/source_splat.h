// The energy of a source map collected into the texels of a cubemap. Internal to
// protocol/light.
#pragma once

#include "protocol/light/environment_map.h"

#include <cstdint>
#include <vector>

namespace relume::light {

// Per texel of a cubemap of side m, with borders as in PaddedCubemap: red, green and blue
// radiance times solid angle, and the solid angle itself, of the parts of the source near it.
// The source is taken in parts no larger than half the largest texel, each shared bilinearly by
// the four texels around it, so that moving a part moves its energy smoothly. All energy is
// counted exactly once; borders are folded in. Small texels may get nothing. The result does
// not depend on the number of threads.
[[nodiscard]] std::vector<float> splat_source(const EnvironmentMap& source, std::uint32_t m);

}  // namespace relume::light
