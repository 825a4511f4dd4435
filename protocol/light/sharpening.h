// What the low-pass of a prefiltered environment blurs too much, given back. Internal to
// protocol/light.
#pragma once

#include "protocol/light/padded_cubemap.h"

#include <cstdint>

namespace relume::light {

// Texels that lie `stride` apart along a row or column exchange `strength` of their difference
// in radiance, times their mean solid angle: energy goes from the darker to the brighter. The
// variance of a spot along either axis falls by 2·strength·stride² texels², while what varies
// with a period of `stride` texels stays as it is, and so does the energy of the whole. A texel
// gives no more than it holds, the limit of flux-corrected transport [Zalesak79], so that no
// radiance becomes negative. `cubemap` has m texels a side and three channels; its borders are
// neither read nor written. Parallel (TBB); the result does not depend on the number of
// threads.
void sharpen(const PaddedCubemap& cubemap,
             std::uint32_t m,
             std::uint32_t stride,
             float strength);

}  // namespace relume::light
